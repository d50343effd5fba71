"""The doors of the gateway: pages, HTTP routes and WebSockets. Translates; decides nothing."""
