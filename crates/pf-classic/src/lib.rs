//! Dijkstra, A* and D* Lite on grids: exact, proven and fast.
