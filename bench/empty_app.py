"""The least that could stand in the gateway's place: a FastAPI application with one route, served by uvicorn.

What it takes to start is what the two of them take. Usage: empty_app.py HOST PORT
"""

import sys

import uvicorn
from fastapi import FastAPI

app = FastAPI()


@app.get("/api/health")
def health() -> dict[str, str]:
    return {}


if __name__ == "__main__":
    uvicorn.run(app, host=sys.argv[1], port=int(sys.argv[2]), log_level="warning", ws="websockets-sansio")
