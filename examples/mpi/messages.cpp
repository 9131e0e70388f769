#define OMPI_SKIP_MPICXX 1
#include "messages.hpp"

#include <mpi.h>

namespace {

constexpr int TAG = 7;

/* Elements as bytes: all processes run the same program on machines of one kind. */
template <typename T> void send(const std::vector<T> &values, int rank)
{
    MPI_Send(values.data(), static_cast<int>(values.size() * sizeof(T)), MPI_BYTE, rank, TAG, MPI_COMM_WORLD);
}

template <typename T> std::vector<T> receive(int rank)
{
    MPI_Status status;
    int bytes = 0;
    MPI_Probe(rank, TAG, MPI_COMM_WORLD, &status);
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    std::vector<T> values(static_cast<std::size_t>(bytes) / sizeof(T));
    MPI_Recv(values.data(), bytes, MPI_BYTE, rank, TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return values;
}

} // namespace

void send_part(const part &p, int rank)
{
    send(std::vector<int>{p.number}, rank);
    send(p.local.points, rank);
    send(p.local.triangles, rank);
    send(p.global, rank);
    send(p.inner_lock, rank);
    send(p.interface_lock, rank);
}

part receive_part(int rank)
{
    part p;
    p.number = receive<int>(rank).at(0);
    p.local.points = receive<point>(rank);
    p.local.triangles = receive<triangle>(rank);
    p.global = receive<std::uint32_t>(rank);
    p.inner_lock = receive<std::uint8_t>(rank);
    p.interface_lock = receive<std::uint8_t>(rank);
    return p;
}

void broadcast(std::vector<std::vector<std::uint32_t>> &lists)
{
    for (auto &list : lists) {
        int size = static_cast<int>(list.size());
        MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
        list.resize(static_cast<std::size_t>(size));
        MPI_Bcast(list.data(), size, MPI_UINT32_T, 0, MPI_COMM_WORLD);
    }
}

void broadcast(std::vector<point> &points, int root)
{
    MPI_Bcast(points.data(), static_cast<int>(points.size() * sizeof(point)), MPI_BYTE, root, MPI_COMM_WORLD);
}

void send_points(const std::vector<point> &points)
{
    send(points, 0);
}

std::vector<point> receive_points(int from)
{
    return receive<point>(from);
}
