// Sending what the example sends, in terms of its own types.
#ifndef MESSAGES_HPP
#define MESSAGES_HPP

#include "decomposition.hpp"

void send_part(const part &p, int rank);
part receive_part(int rank);

/* From process 0 to all. */
void broadcast(std::vector<std::vector<std::uint32_t>> &lists);

/* The points of a list of vertices, from the process `root` to all. */
void broadcast(std::vector<point> &points, int root);

/* From any process to process 0. */
void send_points(const std::vector<point> &points);
std::vector<point> receive_points(int from);

#endif
