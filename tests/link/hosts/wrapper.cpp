// What the C++ header promises: containers of every kind, exceptions, callbacks, maps, and the bits of the C calls.
#include <qsmesh.hpp>

#include "check.h"
#include "torus.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <type_traits>
#if __cplusplus >= 202002L
#include <span>
#endif

// Allocations of this program; those of the library are none of its business. Never inlined, as the compiler would then
// take free for the wrong partner of new.
static std::size_t allocations = 0;

[[gnu::noinline]] void *operator new(std::size_t bytes)
{
    allocations++;
    if (void *room = std::malloc(bytes > 0 ? bytes : 1)) {
        return room;
    }
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void *room) noexcept { std::free(room); }
[[gnu::noinline]] void operator delete(void *room, std::size_t) noexcept { std::free(room); }

namespace {

struct vertex {
    int colour;
    std::array<double, 3> at;
    float texture[2];
};

struct mesh {
    std::vector<double> positions = std::vector<double>(3 * TORUS_VERTICES);
    std::vector<std::uint32_t> triangles = std::vector<std::uint32_t>(TORUS_INDICES);
    mesh() { torus(positions.data(), triangles.data()); }
};

template <typename A, typename B> bool same_bits(const A &a, const B &b)
{
    return a.size() * sizeof a[0] == b.size() * sizeof b[0] &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

mesh smoothed_through_c()
{
    mesh m;
    CHECK(qsm_smooth_f64(m.positions.data(), TORUS_VERTICES, 24, m.triangles.data(), TORUS_INDICES, nullptr, nullptr) ==
          QSM_OK);
    return m;
}

void numbers_points_and_structs_get_the_bits_of_c()
{
    const mesh expected = smoothed_through_c();
    mesh numbers;
    qsmesh::smooth(numbers.positions, numbers.triangles);
    CHECK(same_bits(numbers.positions, expected.positions));

    const mesh before;
    std::vector<std::array<double, 3>> points(TORUS_VERTICES);
    std::memcpy(points.data(), before.positions.data(), sizeof(double) * before.positions.size());
    std::vector<std::array<std::uint32_t, 3>> triples(TORUS_INDICES / 3);
    std::memcpy(triples.data(), before.triangles.data(), sizeof(std::uint32_t) * before.triangles.size());
    std::vector<vertex> vertices(TORUS_VERTICES);
    for (std::size_t v = 0; v < vertices.size(); v++) {
        vertices[v] = vertex{static_cast<int>(v), points[v], {0.25f, 0.5f}};
    }
    qsmesh::smooth(points, triples);
    CHECK(same_bits(points, expected.positions));
    qsmesh::smooth(qsmesh::points_of(vertices, &vertex::at), triples);
    for (std::size_t v = 0; v < vertices.size(); v++) {
        CHECK(vertices[v].at == points[v] && vertices[v].colour == static_cast<int>(v));
        CHECK(vertices[v].texture[0] == 0.25f && vertices[v].texture[1] == 0.5f);
    }
}

void pointers_iterators_and_spans_are_ranges()
{
    const mesh expected = smoothed_through_c();
    mesh between;
    const double *end = between.positions.data() + between.positions.size();
    qsmesh::smooth(qsmesh::points_between(between.positions.data(), const_cast<double *>(end)), between.triangles);
    CHECK(same_bits(between.positions, expected.positions));
#if __cplusplus >= 202002L
    mesh iterated;
    qsmesh::smooth(qsmesh::points_between(iterated.positions.begin(), iterated.positions.end()), iterated.triangles);
    CHECK(same_bits(iterated.positions, expected.positions));
    mesh spanned;
    qsmesh::smooth(std::span(spanned.positions), std::span<const std::uint32_t>(spanned.triangles));
    CHECK(same_bits(spanned.positions, expected.positions));
#endif
}

void single_precision_takes_its_own_call()
{
    mesh exact;
    std::vector<float> a(exact.positions.begin(), exact.positions.end());
    std::vector<float> b = a;
    qsmesh::smooth(a, exact.triangles);
    CHECK(qsm_smooth_f32(b.data(), TORUS_VERTICES, 12, exact.triangles.data(), TORUS_INDICES, nullptr, nullptr) ==
          QSM_OK);
    CHECK(same_bits(a, b));
}

void a_failure_is_an_exception_that_names_the_offender()
{
    mesh m;
    m.triangles[3 * 100 + 1] = 0xFFFFFFFFu;
    const mesh before = m;
    for (qsm_report *out : {static_cast<qsm_report *>(nullptr), static_cast<qsm_report *>(new qsmesh::report)}) {
        try {
            qsmesh::smooth(m.positions, m.triangles, {}, out);
            CHECK(!"it throws");
        } catch (const qsmesh::error &e) {
            CHECK(e.status() == QSM_INDEX_OUT_OF_RANGE && e.offender() == 100);
            CHECK(std::string(e.offender_name()) == "indices");
            CHECK(std::string(e.what()).find("4294967295") != std::string::npos);
        }
        delete static_cast<qsmesh::report *>(out);
    }
    CHECK(same_bits(m.positions, before.positions));
    CHECK(qsmesh::try_smooth(m.positions, m.triangles) == QSM_INDEX_OUT_OF_RANGE);
    m.positions.pop_back();
    try {
        qsmesh::smooth(m.positions, m.triangles);
        CHECK(!"it throws");
    } catch (const qsmesh::error &e) {
        CHECK(std::string(e.offender_name()) == "positions");
    }
}

void a_lock_keeps_vertices_and_must_fit()
{
    mesh m;
    const mesh before;
    std::vector<std::uint8_t> locks(TORUS_VERTICES, 1);
    locks[7] = 0;
    qsmesh::options options;
    qsmesh::smooth(m.positions, m.triangles, options.lock(locks));
    CHECK(!same_bits(m.positions, before.positions));
    std::copy_n(before.positions.begin() + 21, 3, m.positions.begin() + 21);
    CHECK(same_bits(m.positions, before.positions));

    locks.pop_back();
    options.lock(locks);
    CHECK(qsmesh::try_smooth(m.positions, m.triangles, options) == QSM_BAD_OPTION);
    try {
        qsmesh::smooth(m.positions, m.triangles, options);
        CHECK(!"it throws");
    } catch (const qsmesh::error &e) {
        CHECK(std::string(e.offender_name()) == "vertex_lock");
    }
}

void marked_edges_are_features()
{
    mesh m;
    qsmesh::options options;
    options.feature_angle = 0;
    const std::vector<std::array<std::uint32_t, 2>> edges{{0, 1}, {1, 2}};
    qsmesh::report report;
    qsmesh::smooth(m.positions, m.triangles, options.features(edges), &report);
    CHECK(report.feature_edges == 2 && report.moved > 0);
}

void orders_take_containers()
{
    mesh m;
    const mesh before;
    qsmesh::options options;
    const std::vector<std::uint32_t> visits{5, 90, 17};
    qsmesh::report report;
    qsmesh::smooth(m.positions, m.triangles, options.visiting(visits), &report);
    CHECK(report.moved == 3 && options.order == QSM_ORDER_GIVEN);

    mesh front, from_the_worst;
    qsmesh::options wave;
    wave.order = QSM_ORDER_WAVE;
    qsmesh::smooth(from_the_worst.positions, from_the_worst.triangles, wave);
    std::vector<std::uint8_t> seeds(TORUS_VERTICES, 0);
    seeds[TORUS_VERTICES / 2] = 1;
    qsmesh::smooth(front.positions, front.triangles, wave.wave_from(seeds));
    CHECK(!same_bits(front.positions, from_the_worst.positions));
    seeds.pop_back();
    try {
        qsmesh::smooth(front.positions, front.triangles, wave.wave_from(seeds));
        CHECK(!"it throws");
    } catch (const qsmesh::error &e) {
        CHECK(std::string(e.offender_name()) == "seeds");
    }
    wave.order = QSM_ORDER_INDEX;
    qsmesh::smooth(front.positions, front.triangles, wave);

    const std::array<std::uint32_t, 2> missing{0, TORUS_VERTICES};
    try {
        qsmesh::smooth(m.positions, m.triangles, options.visiting(missing));
        CHECK(!"it throws");
    } catch (const qsmesh::error &e) {
        CHECK(e.status() == QSM_VISIT_OUT_OF_RANGE && e.offender() == 1);
    }
}

void progress_is_told_may_stop_and_may_throw()
{
    mesh m;
    const mesh before;
    qsmesh::options options;
    double last = -1;
    options.on_progress = [&last](double done) {
        CHECK(done >= last);
        last = done;
        return qsmesh::flow::proceed;
    };
    mesh moved;
    qsmesh::smooth(moved.positions, moved.triangles, options);
    CHECK(last == 1);

    options.on_progress = [](double) { return qsmesh::flow::cancel; };
    CHECK(qsmesh::try_smooth(m.positions, m.triangles, options) == QSM_CANCELLED);

    options.on_progress = [](double) -> qsmesh::flow { throw std::string("thrown in the callback"); };
    for (int attempt = 0; attempt < 2; attempt++) {
        try {
            if (attempt == 0) {
                qsmesh::smooth(m.positions, m.triangles, options);
            } else {
                (void)qsmesh::try_smooth(m.positions, m.triangles, options);
            }
            CHECK(!"it throws");
        } catch (const std::string &text) {
            CHECK(text == "thrown in the callback");
        }
    }
    CHECK(same_bits(m.positions, before.positions));
}

/* An octahedron with a seventh vertex on one of its faces, which goes. */
struct octahedron {
    std::vector<double> positions{0.5, 0.3, 0.2, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    std::vector<std::uint32_t> triangles{1, 3, 0, 3, 5, 0, 5, 1, 0, 3, 2, 5, 2, 4, 5,
                                         4, 1, 5, 3, 1, 6, 2, 3, 6, 4, 2, 6, 1, 4, 6};
};

void improving_cuts_containers_and_says_where_all_came_from()
{
    octahedron mesh, in_views, in_status;
    qsmesh::options options;
    options.tail_max_angle = 110;
    qsmesh::maps maps;
    qsmesh::report report;
    qsmesh::improve(mesh.positions, mesh.triangles, options, maps, &report);
    CHECK(mesh.positions.size() == 18 && mesh.triangles.size() == 24);
    CHECK((maps.vertex_source == std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6}));
    CHECK(maps.triangle_source.size() == 8 && maps.corner_source.size() == 24 && maps.leftovers.empty());
    CHECK(report.vertices_removed == 1);

    const auto left = qsmesh::improve(qsmesh::points_of(in_views.positions), qsmesh::corners_of(in_views.triangles),
                                      options);
    CHECK(left.vertices == 6 && left.indices == 24 && in_views.positions.size() == 21);
    in_views.positions.resize(18);
    CHECK(same_bits(in_views.positions, mesh.positions));

    qsmesh::counts counts{};
    const auto points = qsmesh::points_of(in_status.positions);
    const auto corners = qsmesh::corners_of(in_status.triangles);
    CHECK(qsmesh::try_collapse_tails(points, corners, counts, options) == QSM_OK && counts.vertices == 6);
    options.tail_max_angle = 10;
    CHECK(qsmesh::try_improve(points, corners, counts, options) == QSM_BAD_OPTION && counts.vertices == 7);
}

void containers_of_points_are_cut_by_points()
{
    const octahedron flat;
    std::vector<std::array<double, 3>> points(7);
    std::memcpy(points.data(), flat.positions.data(), 21 * sizeof(double));
    std::vector<std::array<std::uint32_t, 3>> triangles(10);
    std::memcpy(triangles.data(), flat.triangles.data(), 30 * sizeof(std::uint32_t));
    qsmesh::options options;
    options.tail_max_angle = 110;
    qsmesh::collapse_tails(points, triangles, options);
    CHECK(points.size() == 6 && triangles.size() == 8);
}

void measuring_reads_const_containers()
{
    const mesh m;
    const qsmesh::measurement measured = qsmesh::measure(m.positions, m.triangles);
    CHECK(measured.vertices == TORUS_VERTICES && measured.boundary_edges == 0);
    const auto bins = qsmesh::histogram(m.positions, m.triangles, QSM_MIN_ANGLE, 0, 10, 6);
    std::size_t sum = 0;
    for (const std::size_t count : bins) {
        sum += count;
    }
    CHECK(bins.size() == 6 && sum == measured.triangles);
    try {
        qsmesh::histogram(m.positions, m.triangles, QSM_MIN_ANGLE, 0, -1, 6);
        CHECK(!"it throws");
    } catch (const qsmesh::error &e) {
        CHECK(e.status() == QSM_BAD_OPTION && std::string(e.what()) == qsm_status_string(QSM_BAD_OPTION));
    }
}

void a_call_allocates_nothing_around_the_c_call()
{
    mesh m;
    std::vector<std::uint8_t> locks(TORUS_VERTICES, 0);
    qsmesh::report report;
    const std::size_t before = allocations;
    qsmesh::options options;
    qsmesh::smooth(m.positions, m.triangles, options.lock(locks), &report);
    (void)qsmesh::measure(m.positions, m.triangles);
    (void)qsmesh::improve(qsmesh::points_of(m.positions), qsmesh::corners_of(m.triangles), options);
    CHECK(allocations == before);
}

static_assert(sizeof(qsmesh::points<double>) == 3 * sizeof(void *), "a view is what the C call takes");
static_assert(std::is_trivially_copyable_v<qsmesh::points<float>>);

} // namespace

int main()
{
    numbers_points_and_structs_get_the_bits_of_c();
    pointers_iterators_and_spans_are_ranges();
    single_precision_takes_its_own_call();
    a_failure_is_an_exception_that_names_the_offender();
    a_lock_keeps_vertices_and_must_fit();
    marked_edges_are_features();
    orders_take_containers();
    progress_is_told_may_stop_and_may_throw();
    improving_cuts_containers_and_says_where_all_came_from();
    containers_of_points_are_cut_by_points();
    measuring_reads_const_containers();
    a_call_allocates_nothing_around_the_c_call();
    return 0;
}
