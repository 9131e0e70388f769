/* Misuse of the calls that make a mesh smaller: each has its own status, the report names the offender, and neither a
   buffer nor a count nor a map has changed. */
#include "qsmesh.h"

#include "check.h"
#include "spoilt.h"

#include <math.h>
#include <string.h>

/* All that belongs to a call, so that it can be compared as a whole. */
struct call {
    double exact[3 * SPOILT_VERTICES];
    float positions[3 * SPOILT_VERTICES];
    uint32_t indices[SPOILT_INDICES];
    uint32_t edges[2 * SPOILT_EDGES];
    uint32_t vertex_source[SPOILT_VERTICES];
    uint32_t triangle_source[SPOILT_TRIANGLES];
    uint32_t corner_source[SPOILT_INDICES];
    qsm_leftover leftovers[8];
    size_t vertex_count;
    size_t index_count;
    qsm_maps maps;
    /* So that an array put onto the fields above reaches nothing outside. */
    char margin[8 * sizeof(qsm_leftover)];
};

static struct call call, before;
static qsm_options options;
static qsm_report report;

/* The state from which each misuse starts. */
static void fresh(void)
{
    size_t i;
    memset(&call, 0x5A, sizeof call);
    spoilt(call.exact, call.indices, call.edges);
    for (i = 0; i < 3 * SPOILT_VERTICES; i++) {
        call.positions[i] = (float)call.exact[i];
    }
    call.vertex_count = SPOILT_VERTICES;
    call.index_count = SPOILT_INDICES;
    qsm_maps_init(&call.maps);
    call.maps.vertex_source = call.vertex_source;
    call.maps.triangle_source = call.triangle_source;
    call.maps.corner_source = call.corner_source;
    call.maps.leftovers = call.leftovers;
    call.maps.leftover_capacity = 8;
    call.maps.leftover_count = 99;
    qsm_options_init(&options);
    qsm_report_init(&report);
    options.feature_angle = 0.0;
    options.feature_edges = call.edges;
    options.feature_edge_count = SPOILT_EDGES;
}

/* To be called when a misuse is set up, before the call. */
static void remember(void)
{
    memcpy(&before, &call, sizeof call);
    /* What an earlier call would have left. */
    report.collapsed = 77;
    report.offender = 77;
}

static int all_is_as_before(void)
{
    return memcmp(&before, &call, sizeof call) == 0;
}

static void check_refusal(int line, qsm_status found, qsm_status wanted, const char *name, uint64_t offender)
{
    if (found != wanted || report.status != wanted) {
        fprintf(stderr, "line %d: %s, not %s\n", line, qsm_status_string(found), qsm_status_string(wanted));
        exit(1);
    }
    if (report.offender_name == NULL || strcmp(report.offender_name, name) != 0 || report.offender != offender) {
        const char *blamed = report.offender_name ? report.offender_name : "none";
        fprintf(stderr, "line %d: blames %s, not %s\n", line, blamed, name);
        exit(1);
    }
    CHECK(report.message[0] != '\0');
    CHECK(wanted == QSM_CANCELLED || strstr(report.message, name) != NULL || offender != QSM_NO_OFFENDER);
    CHECK(report.collapsed == 0 && report.struct_size == sizeof report);
    CHECK(all_is_as_before());
}

static qsm_status collapse(float *positions, size_t *vertices, size_t stride, uint32_t *indices, size_t *corners)
{
    remember();
    return qsm_collapse_tails_f32(positions, vertices, stride, indices, corners, &options, &call.maps, &report);
}

static qsm_status improve_doubles(double *positions, size_t *vertices, size_t stride, uint32_t *indices,
                                  size_t *corners)
{
    remember();
    return qsm_improve_f64(positions, vertices, stride, indices, corners, &options, &call.maps, &report);
}

#define REFUSED(wanted, name, made) check_refusal(__LINE__, (made), (wanted), (name), QSM_NO_OFFENDER)
#define REFUSED_AT(wanted, name, offender, made) check_refusal(__LINE__, (made), (wanted), (name), (offender))
#define WHOLE() collapse(call.positions, &call.vertex_count, 12, call.indices, &call.index_count)
#define WHOLE_OF_DOUBLES() improve_doubles(call.exact, &call.vertex_count, 24, call.indices, &call.index_count)

/* The misuses are misuses only if the call is otherwise a good one. */
static void without_misuse_something_is_done(void)
{
    fresh();
    CHECK(WHOLE() == QSM_OK && report.removed > 0 && call.vertex_count < SPOILT_VERTICES);
    fresh();
    CHECK(WHOLE_OF_DOUBLES() == QSM_OK && report.removed > 0 && call.vertex_count < SPOILT_VERTICES);
}

static void null_pointers(void)
{
    size_t *v = &call.vertex_count, *n = &call.index_count;
    fresh();
    REFUSED(QSM_NULL_POINTER, "positions", collapse(NULL, v, 12, call.indices, n));
    REFUSED(QSM_NULL_POINTER, "indices", collapse(call.positions, v, 12, NULL, n));
    REFUSED(QSM_NULL_POINTER, "vertex_count", collapse(call.positions, NULL, 12, call.indices, n));
    REFUSED(QSM_NULL_POINTER, "index_count", collapse(call.positions, v, 12, call.indices, NULL));
    REFUSED(QSM_NULL_POINTER, "vertex_count", improve_doubles(call.exact, NULL, 24, call.indices, n));
    REFUSED(QSM_NULL_POINTER, "index_count", improve_doubles(call.exact, v, 24, call.indices, NULL));
    call.maps.leftovers = NULL;
    REFUSED(QSM_NULL_POINTER, "leftovers", WHOLE());
    fresh();
    options.feature_edges = NULL;
    REFUSED(QSM_NULL_POINTER, "feature_edges", WHOLE());
}

/* The address one byte further. */
static void *askew(void *pointer)
{
    return (char *)pointer + 1;
}

static void misaligned_pointers(void)
{
    size_t *v = &call.vertex_count, *n = &call.index_count;
    fresh();
    REFUSED(QSM_MISALIGNED, "vertex_count", collapse(call.positions, (size_t *)askew(v), 12, call.indices, n));
    REFUSED(QSM_MISALIGNED, "index_count", collapse(call.positions, v, 12, call.indices, (size_t *)askew(n)));
    REFUSED(QSM_MISALIGNED, "positions", collapse((float *)askew(call.positions), v, 12, call.indices, n));
    REFUSED(QSM_MISALIGNED, "indices", collapse(call.positions, v, 12, (uint32_t *)askew(call.indices), n));
    call.maps.vertex_source = (uint32_t *)askew(call.vertex_source);
    REFUSED(QSM_MISALIGNED, "vertex_source", WHOLE());
    fresh();
    call.maps.triangle_source = (uint32_t *)askew(call.triangle_source);
    REFUSED(QSM_MISALIGNED, "triangle_source", WHOLE());
    fresh();
    call.maps.corner_source = (uint32_t *)askew(call.corner_source);
    REFUSED(QSM_MISALIGNED, "corner_source", WHOLE());
    fresh();
    call.maps.leftovers = (qsm_leftover *)askew(call.leftovers);
    REFUSED(QSM_MISALIGNED, "leftovers", WHOLE());
}

static void bad_counts_and_strides(void)
{
    size_t *v = &call.vertex_count, *n = &call.index_count;
    fresh();
    REFUSED(QSM_BAD_STRIDE, "stride_bytes", collapse(call.positions, v, 8, call.indices, n));
    REFUSED(QSM_BAD_STRIDE, "stride_bytes", improve_doubles(call.exact, v, 28, call.indices, n));
    call.index_count--;
    REFUSED(QSM_INDEX_COUNT, "index_count", WHOLE());
    fresh();
    call.vertex_count = (size_t)-1;
    REFUSED(QSM_COUNT_OVERFLOW, "vertex_count", WHOLE());
    fresh();
    call.index_count = (size_t)-1 / 3 * 3;
    REFUSED(QSM_COUNT_OVERFLOW, "index_count", WHOLE());
    fresh();
    call.maps.leftover_capacity = (size_t)-1;
    REFUSED(QSM_COUNT_OVERFLOW, "leftover_capacity", WHOLE());
}

static void bad_elements(void)
{
    fresh();
    call.indices[3 * 41 + 1] = SPOILT_VERTICES;
    REFUSED_AT(QSM_INDEX_OUT_OF_RANGE, "indices", 41, WHOLE());
    fresh();
    call.exact[3 * 17 + 2] = HUGE_VAL;
    REFUSED_AT(QSM_NON_FINITE_VERTEX, "positions", 17, WHOLE_OF_DOUBLES());
    fresh();
    call.edges[2 * 5] = SPOILT_VERTICES;
    REFUSED_AT(QSM_FEATURE_EDGE_OUT_OF_RANGE, "feature_edges", 5, WHOLE());
}

/* qsm_smooth_* takes the same options, and does not look at those of the tail. */
static qsm_status smooth(void)
{
    return qsm_smooth_f32(call.positions, SPOILT_VERTICES, 12, call.indices, SPOILT_INDICES, &options, NULL);
}

#define BAD_OPTION(field, value, smoothed)                     \
    do {                                                       \
        fresh();                                               \
        options.field = (value);                               \
        REFUSED(QSM_BAD_OPTION, #field, WHOLE());              \
        REFUSED(QSM_BAD_OPTION, #field, WHOLE_OF_DOUBLES());   \
        CHECK(smooth() == (smoothed));                         \
    } while (0)

static void bad_options(void)
{
    BAD_OPTION(tail_edge_ratio, 1.0, QSM_OK);
    BAD_OPTION(tail_edge_ratio, HUGE_VAL, QSM_OK);
    BAD_OPTION(tail_min_angle, 0.0, QSM_OK);
    BAD_OPTION(tail_min_angle, 60.0, QSM_OK);
    BAD_OPTION(tail_max_angle, 60.0, QSM_OK);
    BAD_OPTION(tail_max_angle, 180.0, QSM_OK);
    BAD_OPTION(tail_attempts, 0, QSM_OK);
    BAD_OPTION(tail_attempts, 1001, QSM_OK);
    BAD_OPTION(flips, 2, QSM_OK);
    BAD_OPTION(flips, -1, QSM_OK);
    BAD_OPTION(iterations, 10001, QSM_BAD_OPTION);
    BAD_OPTION(plane, 2, QSM_BAD_OPTION);
    BAD_OPTION(max_deviation, -1.0, QSM_BAD_OPTION);
}

static void bad_struct_sizes(void)
{
    static const size_t wrong[] = {0, 8, sizeof(qsm_maps) - 1, sizeof(qsm_maps) + 1, (size_t)-1};
    static const size_t wrong_options[] = {0, sizeof(qsm_options) - 1, sizeof(qsm_options) + 1};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fresh();
        call.maps.struct_size = wrong[i];
        REFUSED(QSM_BAD_STRUCT_SIZE, "maps", WHOLE());
    }
    for (i = 0; i < sizeof wrong_options / sizeof wrong_options[0]; i++) {
        fresh();
        options.struct_size = wrong_options[i];
        REFUSED(QSM_BAD_STRUCT_SIZE, "options", WHOLE());
    }
    fresh();
    report.struct_size = sizeof report + 8;
    CHECK(WHOLE() == QSM_BAD_STRUCT_SIZE);
    CHECK(report.collapsed == 77 && all_is_as_before());
}

#define OVERLAP(field, type, place, name)           \
    do {                                            \
        fresh();                                    \
        call.maps.field = (type *)(void *)(place);  \
        REFUSED(QSM_OVERLAP, name, WHOLE());        \
    } while (0)

static void maps_overlap(void)
{
    OVERLAP(vertex_source, uint32_t, call.indices + SPOILT_INDICES - 1, "vertex_source");
    OVERLAP(vertex_source, uint32_t, call.positions, "vertex_source");
    OVERLAP(triangle_source, uint32_t, call.vertex_source + 1, "triangle_source");
    OVERLAP(corner_source, uint32_t, call.triangle_source + SPOILT_TRIANGLES - 1, "corner_source");
    OVERLAP(leftovers, qsm_leftover, call.corner_source + SPOILT_INDICES - 1, "leftovers");
    OVERLAP(leftovers, qsm_leftover, &call.vertex_count, "leftovers");
    OVERLAP(vertex_source, uint32_t, call.edges, "feature_edges");
    OVERLAP(leftovers, qsm_leftover, &call.maps, "leftovers");
    fresh();
    call.maps.vertex_source = (uint32_t *)(void *)&report;
    remember();
    CHECK(WHOLE() == QSM_OVERLAP);
    CHECK(report.collapsed == 77 && all_is_as_before());
}

static void everything_else_overlaps(void)
{
    size_t *v = &call.vertex_count, *n = &call.index_count;
    size_t *inside;
    fresh();
    call.vertex_count = 300;
    REFUSED(QSM_OVERLAP, "index_count", collapse(call.positions, v, 12, call.indices, v));
    fresh();
    REFUSED(QSM_OVERLAP, "indices", collapse(call.positions, v, 12, (uint32_t *)(void *)call.positions, n));
    inside = (size_t *)(void *)call.exact;
    *inside = 5;
    REFUSED(QSM_OVERLAP, "vertex_count", improve_doubles(call.exact, inside, 24, call.indices, n));
    inside[1] = 30;
    REFUSED(QSM_OVERLAP, "index_count", improve_doubles(call.exact, v, 24, call.indices, inside + 1));
    fresh();
    options.triangle_mask = (uint8_t *)(void *)call.indices;
    REFUSED(QSM_OVERLAP, "triangle_mask", WHOLE());
    fresh();
    options.vertex_lock = (uint8_t *)(void *)call.corner_source;
    REFUSED(QSM_OVERLAP, "vertex_lock", WHOLE());
    fresh();
    options.feature_edges = call.indices;
    REFUSED(QSM_OVERLAP, "feature_edges", WHOLE());
    fresh();
    /* What is only read may be shared. */
    options.triangle_mask = options.vertex_lock = (uint8_t *)(void *)call.exact;
    CHECK(WHOLE() == QSM_OK);
}

static void structs_overlap(void)
{
    qsm_report *inside = (qsm_report *)(void *)call.indices;
    qsm_maps *maps_inside = (qsm_maps *)(void *)call.exact;
    qsm_options *options_inside = (qsm_options *)(void *)call.exact;
    fresh();
    qsm_report_init(inside);
    remember();
    CHECK(qsm_improve_f64(call.exact, &call.vertex_count, 24, call.indices, &call.index_count, NULL, NULL, inside) ==
          QSM_OVERLAP);
    CHECK(all_is_as_before());
    fresh();
    qsm_maps_init(maps_inside);
    remember();
    REFUSED(QSM_OVERLAP, "maps",
            qsm_improve_f64(call.exact, &call.vertex_count, 24, call.indices, &call.index_count, NULL, maps_inside,
                            &report));
    fresh();
    memcpy(options_inside, &options, sizeof options);
    call.maps.vertex_source = (uint32_t *)(void *)call.exact;
    remember();
    REFUSED(QSM_OVERLAP, "options",
            qsm_collapse_tails_f32(call.positions, &call.vertex_count, 12, call.indices, &call.index_count,
                                   options_inside, &call.maps, &report));
}

static double stop_at;

static qsm_flow stop(double done, void *user)
{
    (void)user;
    return done < stop_at ? QSM_CONTINUE : QSM_CANCEL;
}

static qsm_flow answer_nonsense(double done, void *user)
{
    (void)done;
    (void)user;
    return 1234;
}

static void cancelling(void)
{
    static const double when[] = {0.0, 0.3, 0.8, 1.0};
    size_t i;
    fresh();
    options.progress = stop;
    for (i = 0; i < sizeof when / sizeof when[0]; i++) {
        stop_at = when[i];
        REFUSED(QSM_CANCELLED, "progress", WHOLE());
        REFUSED(QSM_CANCELLED, "progress", WHOLE_OF_DOUBLES());
    }
    options.progress = answer_nonsense;
    REFUSED(QSM_CANCELLED, "progress", WHOLE());
}

int main(void)
{
    without_misuse_something_is_done();
    null_pointers();
    misaligned_pointers();
    bad_counts_and_strides();
    bad_elements();
    bad_options();
    bad_struct_sizes();
    maps_overlap();
    everything_else_overlaps();
    structs_overlap();
    cancelling();
    return 0;
}
