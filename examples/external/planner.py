#!/usr/bin/env python3
"""A planner for grids in another language: reads a question a line, answers a line.

    cargo pf plan maps/grids/redlarski/maze-100.map --planner "external:python3 examples/external/planner.py"

The protocol is described in docs/external.md. This one is Dijkstra's algorithm, four or eight moves.
"""
import heapq
import json
import math
import sys


def neighbours(costs, moves, x, y):
    """Where a step may go, and how long it is."""
    free = lambda x, y: 0 <= y < len(costs) and 0 <= x < len(costs[0]) and costs[y][x] > 0
    for dx, dy in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        if free(x + dx, y + dy):
            yield x + dx, y + dy, 1.0
    if moves == "orthogonal":
        return
    # How many of the two cells beside a diagonal step must be free.
    needed = {"always": 0, "one-corner": 1, "no-corner-cutting": 2}[moves]
    for dx, dy in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        if free(x + dx, y + dy) and free(x + dx, y) + free(x, y + dy) >= needed:
            yield x + dx, y + dy, math.sqrt(2)


def shortest(question):
    costs, start, goal = question["costs"], tuple(question["start"]), tuple(question["goal"])
    if not costs[start[1]][start[0]]:
        return None, 0
    best, came, queue, done = {start: 0.0}, {}, [(0.0, start)], set()
    while queue:
        so_far, here = heapq.heappop(queue)
        if here in done:
            continue
        done.add(here)
        if here == goal:
            path = [here]
            while path[-1] in came:
                path.append(came[path[-1]])
            return path[::-1], len(done)
        for x, y, length in neighbours(costs, question["moves"], *here):
            # A step costs its length times the mean cost of its two cells.
            far = so_far + length * (costs[here[1]][here[0]] + costs[y][x]) / 2
            if far < best.get((x, y), math.inf):
                best[x, y], came[x, y] = far, here
                heapq.heappush(queue, (far, (x, y)))
    return None, len(done)


def answer(question):
    if "pf" in question:
        return {"name": "Dijkstra in Python", "problem": "grid", "claims": ["complete", "deterministic"]}
    path, expanded = shortest(question)
    reply = {"id": question["id"], "expanded": expanded}
    return reply | ({"outcome": "feasible", "path": path} if path else {"outcome": "infeasible"})


for line in sys.stdin:
    print(json.dumps(answer(json.loads(line))), flush=True)
