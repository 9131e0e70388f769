// Several processes smooth one surface mesh together: mpirun -n RANKS mpi_parts [PARTS]
//
// The mesh is cut into PARTS parts (4), which the processes share out. In each round every part moves its inner
// vertices, all at once; then the parts, one after another, move the interface vertices that they own. After each step
// the new positions go to the parts that hold them. The result depends on the cut alone: it has the same bits for any
// number of processes, and those of one process that takes the same steps on the whole mesh.
#define OMPI_SKIP_MPICXX 1
#include "decomposition.hpp"
#include "messages.hpp"
#include "torus.hpp"

#include <mpi.h>
#include <qsmesh.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

constexpr int ROUNDS = 3;

/*
 * What makes a part come out as the whole would: vertices are visited by rising number, one round a call, and no edge
 * is a feature by its angle, for that is judged by more of the surface than a part holds.
 */
void smooth_once(mesh &m, const std::vector<std::uint8_t> &locks)
{
    qsmesh::options options;
    options.order = QSM_ORDER_INDEX;
    options.iterations = 1;
    options.feature_angle = 0;
    options.lock(locks);
    qsmesh::smooth(m.points, m.triangles, options);
}

/* The same steps on the whole mesh. */
void smooth_whole(mesh &m, const cut &c)
{
    for (int round = 0; round < ROUNDS; round++) {
        smooth_once(m, c.on_interface);
        for (int number = 0; number < c.parts; number++) {
            std::vector<std::uint8_t> locks;
            for (std::size_t v = 0; v < m.points.size(); v++) {
                locks.push_back(c.owner[v] != number || !c.on_interface[v]);
            }
            smooth_once(m, locks);
        }
    }
}

/* Everything that one process knows. */
struct process {
    int rank = 0;
    int ranks = 1;
    int parts = 4;
    std::vector<part> mine;
    std::vector<std::vector<std::uint32_t>> shared;

    int rank_of(int number) const { return number % ranks; }
};

std::size_t place(const part &p, std::uint32_t global)
{
    return static_cast<std::size_t>(std::lower_bound(p.global.begin(), p.global.end(), global) - p.global.begin());
}

/* The points of the given vertices in a part that holds them all. */
std::vector<point> points_in(const part &p, const std::vector<std::uint32_t> &vertices)
{
    std::vector<point> points;
    for (const std::uint32_t v : vertices) {
        points.push_back(p.local.points[place(p, v)]);
    }
    return points;
}

/* Brings the points that a part shares to all parts that hold them. Many processes would write to neighbours only. */
void exchange(process &all, int number)
{
    const std::vector<std::uint32_t> &vertices = all.shared[static_cast<std::size_t>(number)];
    std::vector<point> points(vertices.size());
    for (const part &p : all.mine) {
        if (p.number == number) {
            points = points_in(p, vertices);
        }
    }
    broadcast(points, all.rank_of(number));
    for (part &p : all.mine) {
        for (std::size_t i = 0; i < vertices.size(); i++) {
            const std::size_t at = place(p, vertices[i]);
            if (at < p.global.size() && p.global[at] == vertices[i]) {
                p.local.points[at] = points[i];
            }
        }
    }
}

void smooth_parts(process &all)
{
    for (int round = 0; round < ROUNDS; round++) {
        for (part &p : all.mine) {
            smooth_once(p.local, p.inner_lock);
        }
        for (int number = 0; number < all.parts; number++) {
            exchange(all, number);
        }
        for (int number = 0; number < all.parts; number++) {
            for (part &p : all.mine) {
                if (p.number == number) {
                    smooth_once(p.local, p.interface_lock);
                }
            }
            exchange(all, number);
        }
    }
}

/* Process 0 cuts; each gets its parts, and the lists of what all share. */
void hand_out(process &all, const mesh &whole, const cut &c)
{
    all.shared.resize(static_cast<std::size_t>(all.parts));
    std::vector<part> parts;
    for (int number = 0; all.rank == 0 && number < all.parts; number++) {
        parts.push_back(make_part(whole, c, number));
    }
    if (all.rank == 0) {
        all.shared = shared_vertices(c, parts);
    }
    broadcast(all.shared);
    for (int number = 0; number < all.parts; number++) {
        const int to = all.rank_of(number);
        if (all.rank == 0 && to != 0) {
            send_part(parts[static_cast<std::size_t>(number)], to);
        } else if (all.rank == to) {
            all.mine.push_back(to == 0 ? parts[static_cast<std::size_t>(number)] : receive_part(0));
        }
    }
}

/* Points of the vertices that a part owns, by global number. */
std::vector<point> owned_points(const part &p)
{
    std::vector<point> points;
    for (std::size_t v = 0; v < p.global.size(); v++) {
        if (!p.inner_lock[v] || !p.interface_lock[v]) {
            points.push_back(p.local.points[v]);
        }
    }
    return points;
}

void put(const cut &c, int number, const std::vector<point> &points, mesh &whole)
{
    auto next = points.begin();
    for (std::size_t v = 0; v < whole.points.size(); v++) {
        if (c.owner[v] == number) {
            whole.points[v] = *next++;
        }
    }
}

/* What every vertex has become at its owner, on process 0. */
void collect(const process &all, const cut &c, mesh &whole)
{
    for (const part &p : all.mine) {
        if (all.rank != 0) {
            send_points(owned_points(p));
        } else {
            put(c, p.number, owned_points(p), whole);
        }
    }
    for (int number = 0; all.rank == 0 && number < all.parts; number++) {
        if (all.rank_of(number) != 0) {
            put(c, number, receive_points(all.rank_of(number)), whole);
        }
    }
}

std::uint64_t hash_of(const std::vector<point> &points)
{
    std::uint64_t hash = 1469598103934665603u;
    const auto *bytes = reinterpret_cast<const unsigned char *>(points.data());
    for (std::size_t i = 0; i < points.size() * sizeof(point); i++) {
        hash = (hash ^ bytes[i]) * 1099511628211u;
    }
    return hash;
}

/* Whether the parts have become what the whole mesh becomes in one process. */
bool judge(const process &all, const cut &c, mesh before, const mesh &after)
{
    const auto on_interface = std::count(c.on_interface.begin(), c.on_interface.end(), 1);
    const qsmesh::measurement first = qsmesh::measure(before.points, before.triangles);
    const qsmesh::measurement last = qsmesh::measure(after.points, after.triangles);
    smooth_whole(before, c);
    const bool same = std::memcmp(before.points.data(), after.points.data(), after.points.size() * sizeof(point)) == 0;
    std::printf("ranks %d, parts %d: %zu vertices, %ld on the interface, angle min %.2f -> %.2f, "
                "edge_ratio mean %.4f -> %.4f\n",
                all.ranks, all.parts, first.vertices, static_cast<long>(on_interface), first.min_angle.min,
                last.min_angle.min, first.edge_ratio.mean, last.edge_ratio.mean);
    std::printf("bits %016llx, %s one process\n", static_cast<unsigned long long>(hash_of(after.points)),
                same ? "the same as" : "NOT those of");
    return same;
}

bool run(process &all)
{
    mesh whole;
    cut c{};
    if (all.rank == 0) {
        whole = make_torus(240, 120);
        c = cut_by_metis(whole, all.parts);
    }
    hand_out(all, whole, c);
    smooth_parts(all);
    mesh after = whole;
    collect(all, c, after);
    return all.rank != 0 || judge(all, c, whole, after);
}

} // namespace

int main(int argc, char **argv)
{
    MPI_Init(&argc, &argv);
    process all;
    MPI_Comm_rank(MPI_COMM_WORLD, &all.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &all.ranks);
    if (argc > 1) {
        all.parts = std::max(1, std::atoi(argv[1]));
    }
    bool good = false;
    try {
        good = run(all);
    } catch (const std::exception &e) {
        std::fprintf(stderr, "process %d: %s\n", all.rank, e.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Finalize();
    return good ? 0 : 1;
}
