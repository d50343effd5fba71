"""What the gateway answers: pages, routes and sockets. Translates; decides nothing."""
