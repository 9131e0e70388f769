/* Every misuse has its own status, the report names the offender, and no buffer has changed. */
#include "qsmesh.h"

#include "check.h"
#include "torus.h"

#include <math.h>
#include <string.h>

static double exact[3 * TORUS_VERTICES];
static float positions[3 * TORUS_VERTICES];
static uint32_t indices[TORUS_INDICES];
static float positions_before[3 * TORUS_VERTICES];
static double exact_before[3 * TORUS_VERTICES];
static uint32_t indices_before[TORUS_INDICES];
static qsm_options options;
static qsm_report report;

/* The state from which each misuse starts. */
static void fresh(void)
{
    size_t i;
    torus(exact, indices);
    for (i = 0; i < 3 * TORUS_VERTICES; i++) {
        positions[i] = (float)exact[i];
    }
    qsm_options_init(&options);
    qsm_report_init(&report);
}

/* To be called when a misuse is set up, before the call. */
static void remember(void)
{
    memcpy(positions_before, positions, sizeof positions);
    memcpy(exact_before, exact, sizeof exact);
    memcpy(indices_before, indices, sizeof indices);
    /* What an earlier call would have left. */
    report.moved = 77;
    report.offender = 77;
}

static int buffers_are_as_before(void)
{
    return memcmp(positions_before, positions, sizeof positions) == 0 &&
           memcmp(exact_before, exact, sizeof exact) == 0 && memcmp(indices_before, indices, sizeof indices) == 0;
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
    CHECK(report.moved == 0 && report.struct_size == sizeof report);
    CHECK(buffers_are_as_before());
}

#define SMOOTH(p, v, s, i, n) (remember(), qsm_smooth_f32((p), (v), (s), (i), (n), &options, &report))
#define REFUSED(call, status, name) check_refusal(__LINE__, (call), (status), (name), QSM_NO_OFFENDER)
#define REFUSED_AT(call, status, name, offender) check_refusal(__LINE__, (call), (status), (name), (offender))
#define WHOLE() SMOOTH(positions, TORUS_VERTICES, 12, indices, TORUS_INDICES)

static void null_pointers(void)
{
    fresh();
    REFUSED(SMOOTH(NULL, TORUS_VERTICES, 12, indices, TORUS_INDICES), QSM_NULL_POINTER, "positions");
    REFUSED(SMOOTH(positions, TORUS_VERTICES, 12, NULL, TORUS_INDICES), QSM_NULL_POINTER, "indices");
    options.feature_edge_count = 1;
    REFUSED(WHOLE(), QSM_NULL_POINTER, "feature_edges");
}

static void bad_shapes_of_buffers(void)
{
    char *bytes = (char *)positions;
    char *index_bytes = (char *)indices;
    fresh();
    REFUSED(SMOOTH(positions, TORUS_VERTICES, 0, indices, TORUS_INDICES), QSM_BAD_STRIDE, "stride_bytes");
    REFUSED(SMOOTH(positions, TORUS_VERTICES, 8, indices, TORUS_INDICES), QSM_BAD_STRIDE, "stride_bytes");
    REFUSED(SMOOTH(positions, TORUS_VERTICES / 2, 14, indices, TORUS_INDICES), QSM_BAD_STRIDE, "stride_bytes");
    REFUSED(SMOOTH((float *)(void *)(bytes + 2), TORUS_VERTICES - 1, 12, indices, 3), QSM_MISALIGNED, "positions");
    REFUSED(SMOOTH(positions, TORUS_VERTICES, 12, (uint32_t *)(void *)(index_bytes + 1), 3), QSM_MISALIGNED, "indices");
    REFUSED(SMOOTH(positions, TORUS_VERTICES, 12, indices, TORUS_INDICES - 1), QSM_INDEX_COUNT, "index_count");
    remember();
    REFUSED(qsm_smooth_f64(exact, TORUS_VERTICES, 20, indices, 3, &options, &report), QSM_BAD_STRIDE, "stride_bytes");
    REFUSED(qsm_smooth_f64(exact, TORUS_VERTICES, 28, indices, 3, &options, &report), QSM_BAD_STRIDE, "stride_bytes");
}

static void counts_beyond_memory(void)
{
    size_t most = (size_t)-1;
    fresh();
    REFUSED(SMOOTH(positions, most, 12, indices, TORUS_INDICES), QSM_COUNT_OVERFLOW, "vertex_count");
    REFUSED(SMOOTH(positions, most / 12, 12, indices, TORUS_INDICES), QSM_COUNT_OVERFLOW, "vertex_count");
    REFUSED(SMOOTH(positions, 3, most / 4 * 4, indices, TORUS_INDICES), QSM_COUNT_OVERFLOW, "vertex_count");
    REFUSED(SMOOTH(positions, TORUS_VERTICES, 12, indices, most / 3 * 3), QSM_COUNT_OVERFLOW, "index_count");
    options.feature_edges = indices;
    options.feature_edge_count = most;
    REFUSED(WHOLE(), QSM_COUNT_OVERFLOW, "feature_edge_count");
}

static void bad_elements(void)
{
    static const float nan_bits[] = {0.0f};
    uint32_t edges[4] = {0, 1, 5, TORUS_VERTICES};
    fresh();
    indices[3 * 41 + 1] = TORUS_VERTICES;
    REFUSED_AT(WHOLE(), QSM_INDEX_OUT_OF_RANGE, "indices", 41);
    fresh();
    positions[3 * 17 + 2] = (float)HUGE_VAL;
    REFUSED_AT(WHOLE(), QSM_NON_FINITE_VERTEX, "positions", 17);
    fresh();
    positions[3 * 18] = nan_bits[0] / nan_bits[0];
    REFUSED_AT(WHOLE(), QSM_NON_FINITE_VERTEX, "positions", 18);
    fresh();
    options.feature_edges = edges;
    options.feature_edge_count = 2;
    REFUSED_AT(WHOLE(), QSM_FEATURE_EDGE_OUT_OF_RANGE, "feature_edges", 1);
}

#define BAD_OPTION(field, value)                 \
    do {                                         \
        fresh();                                 \
        options.field = (value);                 \
        REFUSED(WHOLE(), QSM_BAD_OPTION, #field); \
    } while (0)

static void bad_options(void)
{
    BAD_OPTION(plane, 2);
    BAD_OPTION(plane, -1);
    BAD_OPTION(ideal, 2);
    BAD_OPTION(ideal, -2147483647);
    BAD_OPTION(boundary, 2);
    BAD_OPTION(boundary, 2147483647);
    BAD_OPTION(iterations, 10001);
    BAD_OPTION(relaxation, 0.0);
    BAD_OPTION(relaxation, 2.5);
    BAD_OPTION(interval_width, 0.0);
    BAD_OPTION(sample_limit, HUGE_VAL);
    BAD_OPTION(quality_floor, 1.5);
    BAD_OPTION(feature_angle, 180.0);
    BAD_OPTION(feature_angle, -1.0);
    BAD_OPTION(max_deviation, -1.0);
    BAD_OPTION(max_deviation, -HUGE_VAL);
}

static void bad_struct_sizes(void)
{
    static const size_t wrong[] = {0, 8, sizeof(qsm_options) - 1, sizeof(qsm_options) + 1, (size_t)-1};
    qsm_report untouched;
    qsm_measurement measured;
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fresh();
        options.struct_size = wrong[i];
        REFUSED(WHOLE(), QSM_BAD_STRUCT_SIZE, "options");
    }
    fresh();
    memset(&report, 0x33, sizeof report);
    report.struct_size = sizeof report + 8;
    remember();
    memcpy(&untouched, &report, sizeof report);
    CHECK(qsm_smooth_f32(positions, TORUS_VERTICES, 12, indices, TORUS_INDICES, NULL, &report) == QSM_BAD_STRUCT_SIZE);
    CHECK(memcmp(&untouched, &report, sizeof report) == 0);
    CHECK(buffers_are_as_before());
    measured.struct_size = 1;
    CHECK(qsm_measure_f32(positions, TORUS_VERTICES, 12, indices, TORUS_INDICES, &measured) == QSM_BAD_STRUCT_SIZE);
}

/* A call whose report lies inside one of its own buffers. */
static qsm_status with_report_in(void *place)
{
    qsm_report *inside = (qsm_report *)place;
    fresh();
    qsm_report_init(inside);
    remember();
    return qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, NULL, inside);
}

static void overlaps(void)
{
    uint32_t *inside = (uint32_t *)(void *)(positions + 30);
    fresh();
    REFUSED(SMOOTH(positions, TORUS_VERTICES, 12, inside, 300), QSM_OVERLAP, "indices");
    options.vertex_lock = (uint8_t *)(positions + 2 * TORUS_VERTICES);
    REFUSED(WHOLE(), QSM_OVERLAP, "vertex_lock");
    fresh();
    options.feature_edges = inside;
    options.feature_edge_count = 1;
    REFUSED(WHOLE(), QSM_OVERLAP, "feature_edges");
    CHECK(with_report_in(exact) == QSM_OVERLAP);
    CHECK(buffers_are_as_before());
    CHECK(with_report_in(indices) == QSM_OVERLAP);
    CHECK(buffers_are_as_before());
}

static qsm_status cancel_with(qsm_flow (*progress)(double, void *))
{
    fresh();
    options.progress = progress;
    return WHOLE();
}

static qsm_flow stop_at_once(double done, void *user)
{
    (void)done;
    (void)user;
    return QSM_CANCEL;
}

static qsm_flow stop_at_the_end(double done, void *user)
{
    (void)user;
    return done < 1.0 ? QSM_CONTINUE : QSM_CANCEL;
}

static qsm_flow answer_nonsense(double done, void *user)
{
    (void)done;
    (void)user;
    return 1234;
}

static void cancelling(void)
{
    REFUSED(cancel_with(stop_at_once), QSM_CANCELLED, "progress");
    REFUSED(cancel_with(stop_at_the_end), QSM_CANCELLED, "progress");
    REFUSED(cancel_with(answer_nonsense), QSM_CANCELLED, "progress");
}

static void measuring(void)
{
    qsm_measurement measured;
    qsm_measurement *inside = (qsm_measurement *)(void *)exact;
    fresh();
    remember();
    qsm_measurement_init(&measured);
    CHECK(qsm_measure_f32(positions, TORUS_VERTICES, 12, indices, 3, NULL) == QSM_NULL_POINTER);
    CHECK(qsm_measure_f32(NULL, TORUS_VERTICES, 12, indices, 3, &measured) == QSM_NULL_POINTER);
    CHECK(qsm_measure_f64(exact, TORUS_VERTICES, 12, indices, 3, &measured) == QSM_BAD_STRIDE);
    CHECK(qsm_measure_f64(exact, TORUS_VERTICES, 24, indices, 4, &measured) == QSM_INDEX_COUNT);
    CHECK(qsm_measure_f64(exact, 2, 24, indices, TORUS_INDICES, &measured) == QSM_INDEX_OUT_OF_RANGE);
    CHECK(buffers_are_as_before());
    qsm_measurement_init(inside);
    CHECK(qsm_measure_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, inside) == QSM_OVERLAP);
    CHECK(inside->vertices == 0);
}

static qsm_status histogram(qsm_parameter parameter, double lower, double interval, size_t *counts, size_t bins)
{
    return qsm_histogram_f32(positions, TORUS_VERTICES, 12, indices, TORUS_INDICES, parameter, lower, interval, counts,
                             bins);
}

static void counting(void)
{
    size_t counts[2] = {5, 6};
    fresh();
    remember();
    CHECK(histogram(-1, 0.0, 1.0, counts, 2) == QSM_BAD_OPTION);
    CHECK(histogram(QSM_RADIUS_RATIO + 1, 0.0, 1.0, counts, 2) == QSM_BAD_OPTION);
    CHECK(histogram(QSM_SHAPE, HUGE_VAL, 1.0, counts, 2) == QSM_BAD_OPTION);
    CHECK(histogram(QSM_SHAPE, 0.0, 0.0, counts, 2) == QSM_BAD_OPTION);
    CHECK(histogram(QSM_SHAPE, 0.0, 1.0, counts, 0) == QSM_BAD_OPTION);
    CHECK(histogram(QSM_SHAPE, 0.0, 1.0, NULL, 2) == QSM_NULL_POINTER);
    CHECK(histogram(QSM_SHAPE, 0.0, 1.0, counts, (size_t)-1) == QSM_COUNT_OVERFLOW);
    CHECK(histogram(QSM_SHAPE, 0.0, 1.0, (size_t *)(void *)indices, 2) == QSM_OVERLAP);
    CHECK(qsm_histogram_f64(NULL, 0, 24, NULL, 0, QSM_SHAPE, 0.0, 1.0, counts, (size_t)-1 / 32) == QSM_OUT_OF_MEMORY);
    CHECK(counts[0] == 5 && counts[1] == 6);
    CHECK(buffers_are_as_before());
}

static qsm_status each(qsm_parameter parameter, double *values)
{
    return qsm_triangle_quality_f32(positions, TORUS_VERTICES, 12, indices, TORUS_INDICES, parameter, values);
}

static void values_of_triangles(void)
{
    static double values[TORUS_INDICES / 3];
    fresh();
    remember();
    values[0] = 5.0;
    CHECK(each(-1, values) == QSM_BAD_OPTION);
    CHECK(each(QSM_RADIUS_RATIO + 1, values) == QSM_BAD_OPTION);
    CHECK(each(QSM_SHAPE, NULL) == QSM_NULL_POINTER);
    CHECK(each(QSM_SHAPE, (double *)(void *)((char *)values + 1)) == QSM_MISALIGNED);
    CHECK(qsm_triangle_quality_f64((const double *)(void *)values, 3, 24, indices, 3, QSM_SHAPE, values) == QSM_OVERLAP);
    CHECK(qsm_triangle_quality_f32(positions, 2, 12, indices, TORUS_INDICES, QSM_SHAPE, values) ==
          QSM_INDEX_OUT_OF_RANGE);
    CHECK(values[0] == 5.0);
    CHECK(buffers_are_as_before());
}

int main(void)
{
    null_pointers();
    bad_shapes_of_buffers();
    counts_beyond_memory();
    bad_elements();
    bad_options();
    bad_struct_sizes();
    overlaps();
    cancelling();
    measuring();
    counting();
    values_of_triangles();
    return 0;
}
