/* Meshes that come out smaller: collapsing tails, and improving in one call. */
#include "qsmesh.h"

#include "check.h"
#include "spoilt.h"

#include <math.h>
#include <string.h>

enum {
    VERTICES = SPOILT_VERTICES,
    INDICES = SPOILT_INDICES,
    TRIANGLES = SPOILT_TRIANGLES,
    STRIDE = 32,
    FLOATS = STRIDE / 4,
    SPOILT = SPOILT_NEEDLES + SPOILT_CENTRES
};

/* What no call may write. */
static const uint32_t UNTOUCHED = 0xDEADBEEFu;

static double exact[3 * VERTICES], exact_before[3 * VERTICES];
/* Eight floats a vertex: a position, and five numbers of the caller's own, different for each vertex. */
static float interleaved[FLOATS * VERTICES], interleaved_before[FLOATS * VERTICES];
static double widened[3 * VERTICES];
static uint32_t indices[INDICES], indices_before[INDICES], edges[2 * SPOILT_EDGES];
static uint32_t vertex_source[VERTICES], triangle_source[TRIANGLES], corner_source[INDICES];
static qsm_leftover leftovers[TRIANGLES];
static size_t vertex_count, index_count;
static qsm_options options;
static qsm_maps maps;
static qsm_report report;

static void start_maps(void)
{
    size_t i;
    qsm_maps_init(&maps);
    maps.vertex_source = vertex_source;
    maps.triangle_source = triangle_source;
    maps.corner_source = corner_source;
    maps.leftovers = leftovers;
    maps.leftover_capacity = TRIANGLES;
    for (i = 0; i < INDICES; i++) {
        corner_source[i] = UNTOUCHED;
    }
    memcpy(vertex_source, corner_source, sizeof vertex_source);
    memcpy(triangle_source, corner_source, sizeof triangle_source);
    memset(leftovers, 0x77, sizeof leftovers);
}

static void start(void)
{
    size_t v, k;
    spoilt(exact, indices, edges);
    for (v = 0; v < VERTICES; v++) {
        for (k = 0; k < FLOATS; k++) {
            interleaved[FLOATS * v + k] = k < 3 ? (float)exact[3 * v + k] : (float)(FLOATS * v + k);
        }
    }
    memcpy(exact_before, exact, sizeof exact);
    memcpy(interleaved_before, interleaved, sizeof interleaved);
    memcpy(indices_before, indices, sizeof indices);
    vertex_count = VERTICES;
    index_count = INDICES;
    qsm_options_init(&options);
    qsm_report_init(&report);
    options.feature_angle = 0.0;
    options.feature_edges = edges;
    options.feature_edge_count = SPOILT_EDGES;
    start_maps();
}

static qsm_status collapse(void)
{
    return qsm_collapse_tails_f64(exact, &vertex_count, 24, indices, &index_count, &options, &maps, &report);
}

static qsm_status improve(void)
{
    return qsm_improve_f64(exact, &vertex_count, 24, indices, &index_count, &options, &maps, &report);
}

static void check_vertex_map(void)
{
    size_t v;
    for (v = 0; v < vertex_count; v++) {
        CHECK(vertex_source[v] < VERTICES);
        CHECK(v == 0 || vertex_source[v] > vertex_source[v - 1]);
    }
    for (; v < VERTICES; v++) {
        CHECK(vertex_source[v] == UNTOUCHED);
    }
}

/* Whether a triangle has the corners of its source, in the same order. */
static int unchanged(size_t t)
{
    size_t k, same = 0;
    for (k = 0; k < 3; k++) {
        same += vertex_source[indices[3 * t + k]] == indices_before[3 * triangle_source[t] + k];
    }
    return same == 3;
}

/* A corner comes from the same vertex, and in a triangle that has not changed from where it is. */
static void check_corner(size_t corner)
{
    CHECK(corner_source[corner] < INDICES);
    CHECK(indices_before[corner_source[corner]] == vertex_source[indices[corner]]);
    CHECK(!unchanged(corner / 3) || corner_source[corner] == 3 * triangle_source[corner / 3] + corner % 3);
}

static void check_triangle_maps(void)
{
    size_t t, corner, same = 0, count = index_count / 3;
    for (corner = 0; corner < index_count; corner++) {
        CHECK(indices[corner] < vertex_count);
        CHECK(triangle_source[corner / 3] < TRIANGLES);
        check_corner(corner);
    }
    for (t = 0; t < count; t++) {
        same += unchanged(t) != 0;
    }
    CHECK(fabs((double)same / TRIANGLES - report.triangles_unchanged) < 1e-12);
    for (t = count; t < TRIANGLES; t++) {
        CHECK(triangle_source[t] == UNTOUCHED && corner_source[3 * t] == UNTOUCHED);
    }
    CHECK(index_count == INDICES || corner_source[index_count] == UNTOUCHED);
}

static void check_report(double bound)
{
    CHECK(report.status == QSM_OK && report.offender == QSM_NO_OFFENDER && report.offender_name == NULL);
    CHECK(report.before.vertices == VERTICES && report.before.triangles == TRIANGLES);
    CHECK(report.after.vertices == vertex_count && report.after.triangles == index_count / 3);
    CHECK(report.vertices_removed == VERTICES - vertex_count);
    CHECK(report.triangles_removed == TRIANGLES - index_count / 3);
    CHECK(report.after.boundary_edges == 0 && report.after.non_manifold_edges == 0);
    CHECK(fabs(report.volume_relative_change) <= bound);
    CHECK(report.max_deviation > 0.0 && report.max_deviation < 0.5);
    CHECK(report.seconds.tail > 0.0 && report.seconds.total >= report.seconds.tail);
    CHECK(report.struct_size == sizeof report);
}

/* The mesh is smaller, most of it is the same, and no tail is worse than what the report lists. */
static void check_shrunk(double bound)
{
    CHECK(vertex_count < VERTICES && vertex_count >= VERTICES - VERTICES / 20);
    CHECK(INDICES - index_count == 6 * (VERTICES - vertex_count));
    CHECK(report.tails_before >= SPOILT && report.tails_after < report.tails_before / 2);
    CHECK(report.tails_after == maps.leftover_count);
    CHECK(report.collapsed + report.removed == report.vertices_removed);
    CHECK(report.triangles_unchanged > 0.8 && report.triangles_unchanged < 1.0);
    check_report(bound);
    check_vertex_map();
    check_triangle_maps();
}

static void init_function_sets_the_size(void)
{
    qsm_maps fresh;
    memset(&fresh, 0xFF, sizeof fresh);
    qsm_maps_init(&fresh);
    CHECK(fresh.struct_size == sizeof fresh);
    CHECK(fresh.vertex_source == NULL && fresh.triangle_source == NULL && fresh.corner_source == NULL);
    CHECK(fresh.leftovers == NULL && fresh.leftover_capacity == 0 && fresh.leftover_count == 0);
    qsm_maps_init(NULL);
    qsm_options_init(&options);
    CHECK(options.tail_edge_ratio == 3.0 && options.tail_min_angle == 20.0 && options.tail_max_angle == 130.0);
    CHECK(options.tail_attempts == 3 && options.flips == 0 && options.tail_operations == 0);
    CHECK(options.triangle_mask == NULL);
}

static void doubles_lose_needles_and_caps(void)
{
    double volume;
    size_t v, still = 0;
    start();
    volume = enclosed_volume(exact, indices, INDICES);
    CHECK(collapse() == QSM_OK);
    check_shrunk(1e-12);
    CHECK(report.moved == 0 && report.kept.settled == 0 && report.seconds.sweeps == 0.0);
    CHECK(fabs(enclosed_volume(exact, indices, index_count) - volume) <= 1e-12 * volume);
    for (v = 0; v < vertex_count; v++) {
        still += memcmp(exact + 3 * v, exact_before + 3 * vertex_source[v], 24) == 0;
    }
    CHECK(still > VERTICES * 3 / 4);
    CHECK(memcmp(exact + 3 * v, exact_before + 3 * v, 24 * (VERTICES - v)) == 0);
    CHECK(memcmp(indices + index_count, indices_before + index_count, 4 * (INDICES - index_count)) == 0);
}

static double volume_of_floats(void)
{
    size_t i;
    for (i = 0; i < 3 * VERTICES; i++) {
        widened[i] = interleaved[i / 3 * FLOATS + i % 3];
    }
    return enclosed_volume(widened, indices, index_count);
}

/* What the header tells a caller to do with attributes. */
static void bring_attributes_along(void)
{
    size_t v;
    for (v = 0; v < vertex_count; v++) {
        memmove(interleaved + FLOATS * v + 3, interleaved + FLOATS * vertex_source[v] + 3, STRIDE - 12);
    }
}

static void only_coordinates_move_up(qsm_status (*call)(float *, size_t *, size_t, uint32_t *, size_t *,
                                                        const qsm_options *, qsm_maps *, qsm_report *))
{
    double volume;
    size_t v;
    start();
    volume = volume_of_floats();
    CHECK(call(interleaved, &vertex_count, STRIDE, indices, &index_count, &options, &maps, &report) == QSM_OK);
    check_shrunk(1e-6);
    CHECK(fabs(volume_of_floats() - volume) <= 1e-6 * volume);
    for (v = 0; v < VERTICES; v++) {
        CHECK(memcmp(interleaved + FLOATS * v + 3, interleaved_before + FLOATS * v + 3, STRIDE - 12) == 0);
        CHECK(v < vertex_count || memcmp(interleaved + FLOATS * v, interleaved_before + FLOATS * v, 12) == 0);
    }
    bring_attributes_along();
    for (v = 0; v < vertex_count; v++) {
        CHECK(interleaved[FLOATS * v + 7] == (float)(FLOATS * vertex_source[v] + 7));
    }
}

static void interleaved_floats(void)
{
    only_coordinates_move_up(qsm_collapse_tails_f32);
    only_coordinates_move_up(qsm_improve_f32);
}

static double edge(const double *a, const double *b)
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

static int is_tail(size_t t)
{
    static const double degree = 57.29577951308232;
    double low = 180.0, high = 0.0, side[3];
    size_t k;
    for (k = 0; k < 3; k++) {
        side[k] = edge(exact + 3 * indices[3 * t + k], exact + 3 * indices[3 * t + (k + 1) % 3]);
    }
    for (k = 0; k < 3; k++) {
        double a = side[k], b = side[(k + 1) % 3], c = side[(k + 2) % 3];
        double cosine = (a * a + b * b - c * c) / (2.0 * a * b);
        double angle = degree * acos(cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine);
        low = angle < low ? angle : low;
        high = angle > high ? angle : high;
        if (a > options.tail_edge_ratio * b || b > options.tail_edge_ratio * a) {
            return 1;
        }
    }
    return low < options.tail_min_angle || high > options.tail_max_angle;
}

/* The list has every tail that is left, in order, and no other triangle. */
static void check_leftovers(void)
{
    size_t t, n = 0;
    for (t = 0; t < index_count / 3; t++) {
        int listed = n < maps.leftover_count && leftovers[n].triangle == t;
        CHECK(is_tail(t) == listed);
        if (listed) {
            CHECK(leftovers[n].defect >= QSM_DEFECT_DEGENERATE && leftovers[n].defect <= QSM_DEFECT_SMALL_ANGLE);
            CHECK(leftovers[n].reason >= QSM_REASON_FEATURE && leftovers[n].reason <= QSM_REASON_NO_GAIN);
            n++;
        }
    }
    CHECK(n == maps.leftover_count && n == report.tails_after);
    CHECK(n == TRIANGLES || leftovers[n].triangle == 0x77777777u);
}

static size_t leftovers_by(qsm_defect defect, qsm_reason reason)
{
    size_t n, count = 0;
    for (n = 0; n < maps.leftover_count; n++) {
        count += leftovers[n].defect == defect && leftovers[n].reason == reason;
    }
    return count;
}

static void locked_vertices_survive_and_their_tails_are_listed(void)
{
    static uint8_t lock[VERTICES];
    size_t v, found = 0;
    start();
    memset(lock, 255, sizeof lock);
    memset(lock + SPOILT_CENTRES / 2, 0, SPOILT_CENTRES / 2);
    memset(lock + VERTICES / 2, 0, VERTICES / 2);
    options.vertex_lock = lock;
    CHECK(collapse() == QSM_OK);
    for (v = 0; v < vertex_count; v++) {
        if (lock[vertex_source[v]] != 0) {
            CHECK(memcmp(exact + 3 * v, exact_before + 3 * vertex_source[v], 24) == 0);
            found++;
        }
    }
    CHECK(found == VERTICES / 2 - SPOILT_CENTRES / 2 && vertex_count < VERTICES);
    check_leftovers();
CHECK(leftovers_by(QSM_DEFECT_NEEDLE, QSM_REASON_LOCKED) >= 2);
}

static void everything_locked_leaves_everything(void)
{
    static uint8_t lock[VERTICES];
    start();
    memset(lock, 1, sizeof lock);
    options.vertex_lock = lock;
    CHECK(collapse() == QSM_OK);
    CHECK(vertex_count == VERTICES && index_count == INDICES);
    CHECK(memcmp(exact, exact_before, sizeof exact) == 0);
    check_leftovers();
    CHECK(leftovers_by(QSM_DEFECT_NEEDLE, QSM_REASON_LOCKED) >= SPOILT_NEEDLES);
    check_vertex_map();
    check_triangle_maps();
}

static void short_lists_are_filled_and_the_rest_is_counted(void)
{
    size_t all;
    start();
    options.tail_operations = 1;
    CHECK(collapse() == QSM_OK);
    check_leftovers();
    all = maps.leftover_count;
    CHECK(all > 2 && report.collapsed + report.removed + report.flipped + report.tail_moved == 1);
    start();
    options.tail_operations = 1;
    maps.leftover_capacity = 2;
    CHECK(collapse() == QSM_OK);
    CHECK(maps.leftover_count == all && maps.leftover_capacity == 2);
    CHECK(leftovers[1].triangle < TRIANGLES && leftovers[2].triangle == 0x77777777u);
    start();
    options.tail_operations = 1;
    maps.leftovers = NULL;
    maps.leftover_capacity = 0;
    CHECK(collapse() == QSM_OK);
    CHECK(maps.leftover_count == all && leftovers[0].triangle == 0x77777777u);
}

/* The mesh comes out the same, whether or not anyone asks what happened to it. */
static void nothing_but_the_mesh_is_required(void)
{
    static double wanted[3 * VERTICES];
    static uint32_t wanted_indices[INDICES];
    start();
    CHECK(improve() == QSM_OK);
    memcpy(wanted, exact, sizeof exact);
    memcpy(wanted_indices, indices, sizeof indices);
    start();
    CHECK(qsm_improve_f64(exact, &vertex_count, 24, indices, &index_count, &options, NULL, NULL) == QSM_OK);
    CHECK(vertex_count < VERTICES && index_count < INDICES);
    CHECK(memcmp(wanted, exact, sizeof exact) == 0 && memcmp(wanted_indices, indices, sizeof indices) == 0);
    start();
    qsm_maps_init(&maps);
    CHECK(improve() == QSM_OK);
    CHECK(memcmp(wanted, exact, sizeof exact) == 0 && memcmp(wanted_indices, indices, sizeof indices) == 0);
    CHECK(vertex_source[0] == UNTOUCHED && triangle_source[0] == UNTOUCHED && corner_source[0] == UNTOUCHED);
    start();
    CHECK(qsm_collapse_tails_f64(exact, &vertex_count, 24, indices, &index_count, NULL, NULL, NULL) == QSM_OK);
    CHECK(memcmp(exact_before, exact, sizeof exact) != 0);
}

static size_t kept(const qsm_kept *k)
{
    return k->unreferenced + k->locked + k->non_manifold + k->degenerate + k->boundary + k->corner + k->guard +
           k->deviation + k->settled;
}

static void improving_is_more_than_either_part(void)
{
    qsm_report alone;
    qsm_measurement measured;
    start();
    CHECK(collapse() == QSM_OK);
    alone = report;
    start();
    CHECK(improve() == QSM_OK);
    check_shrunk(1e-12);
    check_leftovers();
    CHECK(memcmp(&alone.before, &report.before, sizeof alone.before) == 0);
    CHECK(report.after.edge_ratio.mean < alone.after.edge_ratio.mean);
    CHECK(report.after.min_angle.mean > alone.after.min_angle.mean);
    CHECK(report.tails_before < alone.tails_before);
    CHECK(report.moved > VERTICES / 2 && report.moved + kept(&report.kept) == VERTICES);
    CHECK(report.seconds.sweeps > 0.0);
    qsm_measurement_init(&measured);
    CHECK(qsm_measure_f64(exact, vertex_count, 24, indices, index_count, &measured) == QSM_OK);
    CHECK(measured.below_20 == report.after.below_20);
    CHECK(fabs(measured.edge_ratio.mean - report.after.edge_ratio.mean) < 1e-12);
}

static void improving_without_sweeps_is_collapsing(void)
{
    static double wanted[3 * VERTICES];
    start();
    CHECK(collapse() == QSM_OK);
    memcpy(wanted, exact, sizeof exact);
    start();
    options.iterations = 0;
    CHECK(improve() == QSM_OK);
    CHECK(memcmp(wanted, exact, sizeof exact) == 0);
    check_shrunk(1e-12);
    CHECK(report.moved == 0);
}

static void check_nothing_done(void)
{
    CHECK(collapse() == QSM_OK);
    CHECK(report.tails_before == 0 && maps.leftover_count == 0 && report.triangles_unchanged == 1.0);
    CHECK(vertex_count == VERTICES && index_count == INDICES);
    CHECK(memcmp(exact, exact_before, sizeof exact) == 0 && memcmp(indices, indices_before, sizeof indices) == 0);
    check_vertex_map();
    check_triangle_maps();
}

static void thresholds_and_mask_say_what_is_a_tail(void)
{
    static uint8_t mask[TRIANGLES];
    start();
    options.tail_edge_ratio = 1e9;
    options.tail_min_angle = 1e-6;
    options.tail_max_angle = 179.999999;
    check_nothing_done();
    start();
    memset(mask, 0, sizeof mask);
    options.triangle_mask = mask;
    check_nothing_done();
    /* The three triangles around the first centre. */
    mask[2 * spoilt_at(SPOILT_NEEDLES)] = 255;
    memset(mask + TRIANGLES - 2 * SPOILT_CENTRES, 1, 2);
    CHECK(collapse() == QSM_OK);
    CHECK(report.tails_before >= 1 && report.tails_before <= 3 && report.removed == 1);
    CHECK(vertex_count == VERTICES - 1 && vertex_source[0] == 1);
}

static void flips_are_made_when_asked_for(void)
{
    start();
    CHECK(improve() == QSM_OK);
    CHECK(report.general_flips == 0);
    start();
    options.flips = 1;
    CHECK(improve() == QSM_OK);
    CHECK(report.general_flips > 0);
    check_report(1e-12);
    check_vertex_map();
    check_triangle_maps();
}

struct follower {
    double last;
    size_t calls;
};

static qsm_flow follow(double done, void *user)
{
    struct follower *follower = (struct follower *)user;
    CHECK(done >= follower->last && done <= 1.0);
    CHECK(follower->calls > 0 || done == 0.0);
    follower->last = done;
    follower->calls++;
    return QSM_CONTINUE;
}

static void progress_rises_from_0_to_1(qsm_status (*call)(void))
{
    struct follower follower = {0.0, 0};
    start();
    options.progress = follow;
    options.user = &follower;
    CHECK(call() == QSM_OK);
    CHECK(follower.calls >= 2 && follower.last == 1.0);
}

static void nothing_is_a_mesh_too(void)
{
    float lone[3] = {1.0f, 2.0f, 3.0f};
    start();
    options.feature_edge_count = 0;
    vertex_count = index_count = 0;
    CHECK(qsm_improve_f32(NULL, &vertex_count, 12, NULL, &index_count, &options, &maps, &report) == QSM_OK);
    CHECK(vertex_count == 0 && index_count == 0 && maps.leftover_count == 0);
    CHECK(vertex_source[0] == UNTOUCHED);
    vertex_count = 1;
    CHECK(qsm_collapse_tails_f32(lone, &vertex_count, 12, NULL, &index_count, &options, &maps, &report) == QSM_OK);
    CHECK(vertex_count == 1 && index_count == 0 && vertex_source[0] == 0 && vertex_source[1] == UNTOUCHED);
    CHECK(lone[0] == 1.0f && lone[1] == 2.0f && lone[2] == 3.0f);
}

int main(void)
{
    init_function_sets_the_size();
    doubles_lose_needles_and_caps();
    interleaved_floats();
    locked_vertices_survive_and_their_tails_are_listed();
    everything_locked_leaves_everything();
    short_lists_are_filled_and_the_rest_is_counted();
    nothing_but_the_mesh_is_required();
    improving_is_more_than_either_part();
    improving_without_sweeps_is_collapsing();
    thresholds_and_mask_say_what_is_a_tail();
    flips_are_made_when_asked_for();
    progress_rises_from_0_to_1(collapse);
    progress_rises_from_0_to_1(improve);
    nothing_is_a_mesh_too();
    return 0;
}
