/* What the calls do, in the C of 1989. Included twice: the include guard has to hold. */
#include "qsmesh.h"
#include "qsmesh.h"

#include "check.h"
#include "torus.h"

#include <math.h>
#include <string.h>

enum { STRIDE = 32, GAP = STRIDE - 12 };

static double exact[3 * TORUS_VERTICES];
static uint32_t indices[TORUS_INDICES];
static uint32_t indices_before[TORUS_INDICES];

static float tight[3 * TORUS_VERTICES];
/* Eight floats a vertex: a position, and five numbers that are none of the library's business. */
static float interleaved[8 * TORUS_VERTICES];
static double widened[3 * TORUS_VERTICES];

static void start(void)
{
    size_t v, k;
    torus(exact, indices);
    memcpy(indices_before, indices, sizeof indices);
    memset(interleaved, 0xA5, sizeof interleaved);
    for (v = 0; v < TORUS_VERTICES; v++) {
        for (k = 0; k < 3; k++) {
            tight[3 * v + k] = (float)exact[3 * v + k];
            interleaved[8 * v + k] = tight[3 * v + k];
        }
    }
}

static double volume_of_floats(void)
{
    size_t i;
    for (i = 0; i < 3 * TORUS_VERTICES; i++) {
        widened[i] = tight[i];
    }
    return torus_volume(widened, indices);
}

static size_t kept(const qsm_kept *k)
{
    return k->unreferenced + k->locked + k->non_manifold + k->degenerate + k->boundary + k->corner + k->guard +
           k->deviation + k->settled;
}

static void check_report(const qsm_report *report, double bound)
{
    CHECK(report->status == QSM_OK);
    CHECK(report->offender == QSM_NO_OFFENDER);
    CHECK(report->offender_name == NULL);
    CHECK(report->message[0] == '\0');
    CHECK(report->before.vertices == TORUS_VERTICES);
    CHECK(report->before.triangles == TORUS_INDICES / 3);
    CHECK(report->after.edge_ratio.mean < report->before.edge_ratio.mean);
    CHECK(report->after.shape.mean > report->before.shape.mean);
    CHECK(report->after.boundary_edges == 0);
    CHECK(fabs(report->volume_relative_change) <= bound);
    CHECK(report->moved > TORUS_VERTICES / 2);
    CHECK(report->moved + kept(&report->kept) == TORUS_VERTICES);
    CHECK(report->max_deviation > 0.0);
    CHECK(report->struct_size == sizeof *report);
}

static void zeroed_outputs_are_as_good_as_initialised_ones(void)
{
    static const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint32_t triangle[] = {0, 1, 2};
    float copy[9];
    qsm_report report;
    qsm_measurement measurement;
    memcpy(copy, corners, sizeof copy);
    memset(&report, 0, sizeof report);
    memset(&measurement, 0, sizeof measurement);
    CHECK(qsm_smooth_f32(copy, 3, 12, triangle, 3, NULL, &report) == QSM_OK);
    CHECK(report.kept.boundary == 3 && report.before.triangles == 1);
    CHECK(qsm_measure_f32(copy, 3, 12, triangle, 3, &measurement) == QSM_OK);
    CHECK(measurement.triangles == 1 && measurement.area == 0.5);
}

static void init_functions_set_sizes(void)
{
    qsm_options options;
    qsm_report report;
    qsm_measurement measurement;
    memset(&options, 0xFF, sizeof options);
    qsm_options_init(&options);
    qsm_report_init(&report);
    qsm_measurement_init(&measurement);
    CHECK(options.struct_size == sizeof options);
    CHECK(report.struct_size == sizeof report);
    CHECK(measurement.struct_size == sizeof measurement);
    CHECK(options.iterations == 2);
    CHECK(options.plane == QSM_PLANE_VECTOR_AREA);
    CHECK(options.feature_angle == 30.0);
    CHECK(options.max_deviation > 1e308);
    CHECK(options.vertex_lock == NULL);
    CHECK(options.feature_edges == NULL && options.feature_edge_count == 0);
    CHECK(options.progress == NULL);
    qsm_options_init(NULL);
    qsm_report_init(NULL);
    qsm_measurement_init(NULL);
}

static void floats_of_any_stride(void)
{
    static float tight_before[3 * TORUS_VERTICES];
    qsm_report report;
    double volume;
    size_t v;
    unsigned char gap[GAP];
    start();
    memset(gap, 0xA5, sizeof gap);
    memcpy(tight_before, tight, sizeof tight);
    volume = volume_of_floats();
    qsm_report_init(&report);
    CHECK(qsm_smooth_f32(interleaved, TORUS_VERTICES, STRIDE, indices, TORUS_INDICES, NULL, &report) == QSM_OK);
    check_report(&report, 1e-6);
    CHECK(qsm_smooth_f32(tight, TORUS_VERTICES, 12, indices, TORUS_INDICES, NULL, NULL) == QSM_OK);
    CHECK(memcmp(tight, tight_before, sizeof tight) != 0);
    CHECK(fabs(volume_of_floats() - volume) <= 1e-6 * volume);
    for (v = 0; v < TORUS_VERTICES; v++) {
        CHECK(memcmp(interleaved + 8 * v, tight + 3 * v, 12) == 0);
        CHECK(memcmp(interleaved + 8 * v + 3, gap, sizeof gap) == 0);
    }
    CHECK(memcmp(indices, indices_before, sizeof indices) == 0);
}

static void doubles_keep_the_volume(void)
{
    qsm_report report;
    double volume;
    start();
    volume = torus_volume(exact, indices);
    qsm_report_init(&report);
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, NULL, &report) == QSM_OK);
    check_report(&report, 1e-12);
    CHECK(fabs(torus_volume(exact, indices) - volume) <= 1e-12 * volume);
}

static void locked_vertices_keep_their_bits(void)
{
    static uint8_t lock[TORUS_VERTICES];
    static double before[3 * TORUS_VERTICES];
    qsm_options options;
    qsm_report report;
    size_t v, locked = 0;
    start();
    memcpy(before, exact, sizeof exact);
    for (v = 0; v < TORUS_VERTICES; v++) {
        lock[v] = (uint8_t)(v % 3 == 0 ? 255 : 0);
        locked += lock[v] != 0;
    }
    qsm_options_init(&options);
    qsm_report_init(&report);
    options.vertex_lock = lock;
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &options, &report) == QSM_OK);
    CHECK(report.kept.locked == locked);
    CHECK(report.moved > 0);
    for (v = 0; v < TORUS_VERTICES; v += 3) {
        CHECK(memcmp(exact + 3 * v, before + 3 * v, 24) == 0);
    }
}

static void marked_edges_are_features(void)
{
    uint32_t edges[4];
    qsm_options options;
    qsm_report report;
    start();
    memcpy(edges, indices, sizeof(uint32_t) * 2);
    memcpy(edges + 2, indices + 7, sizeof(uint32_t) * 2);
    qsm_options_init(&options);
    qsm_report_init(&report);
    options.feature_angle = 0.0;
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &options, &report) == QSM_OK);
    CHECK(report.feature_edges == 0);
    options.feature_edges = edges;
    options.feature_edge_count = 2;
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &options, &report) == QSM_OK);
    CHECK(report.feature_edges == 2);
}

static void options_reach_the_library(void)
{
    static double before[3 * TORUS_VERTICES];
    qsm_options options;
    qsm_report report;
    start();
    memcpy(before, exact, sizeof exact);
    qsm_options_init(&options);
    qsm_report_init(&report);
    options.iterations = 0;
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &options, &report) == QSM_OK);
    CHECK(report.moved == 0);
    CHECK(memcmp(exact, before, sizeof exact) == 0);
    options.iterations = 2;
    options.max_deviation = 1e-3;
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &options, &report) == QSM_OK);
    CHECK(report.max_deviation > 0.0 && report.max_deviation <= 1e-3);
}

/* Constants may lie in memory that cannot be written: a vertex that does not move is only read. */
static void vertices_that_stay_are_not_written(void)
{
    static const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    qsm_options options;
    qsm_options_init(&options);
    options.iterations = 0;
    CHECK(qsm_smooth_f64((double *)corners, 4, 24, faces, 12, &options, NULL) == QSM_OK);
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

static void progress_rises_from_0_to_1(void)
{
    struct follower follower = {0.0, 0};
    qsm_options options;
    start();
    qsm_options_init(&options);
    options.progress = follow;
    options.user = &follower;
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &options, NULL) == QSM_OK);
    CHECK(follower.calls >= 2);
    CHECK(follower.last == 1.0);
}

static void measuring_agrees_with_the_report(void)
{
    qsm_measurement measured;
    qsm_report report;
    start();
    qsm_report_init(&report);
    qsm_measurement_init(&measured);
    CHECK(qsm_measure_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &measured) == QSM_OK);
    CHECK(qsm_smooth_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, NULL, &report) == QSM_OK);
    CHECK(memcmp(&measured, &report.before, sizeof measured) == 0);
    CHECK(fabs(measured.volume - 39.0) < 1.0);
    CHECK(qsm_measure_f32(interleaved, TORUS_VERTICES, STRIDE, indices, TORUS_INDICES, &measured) == QSM_OK);
    CHECK(fabs(measured.volume - report.before.volume) < 1e-5);
    CHECK(measured.edge_ratio.count == TORUS_INDICES / 3);
}

static void each_triangle_has_its_quality(void)
{
    double angles[TORUS_INDICES / 3], least = 180.0;
    qsm_measurement measured;
    size_t k;
    start();
    qsm_measurement_init(&measured);
    CHECK(qsm_measure_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, &measured) == QSM_OK);
    CHECK(qsm_triangle_quality_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, QSM_MIN_ANGLE, angles) == QSM_OK);
    for (k = 0; k < TORUS_INDICES / 3; k++) {
        least = angles[k] < least ? angles[k] : least;
    }
    CHECK(least == measured.min_angle.min);
    CHECK(qsm_triangle_quality_f32(tight, TORUS_VERTICES, 12, indices, 3, QSM_EDGE_RATIO, angles) == QSM_OK);
    CHECK(angles[0] >= 1.0 && angles[0] < 100.0);
    CHECK(qsm_triangle_quality_f32(NULL, 0, 12, NULL, 0, QSM_EDGE_RATIO, NULL) == QSM_OK);
}

static void histograms_count_every_triangle(void)
{
    size_t narrow[6], wide[6], total = 0, k;
    start();
    CHECK(qsm_histogram_f64(exact, TORUS_VERTICES, 24, indices, TORUS_INDICES, QSM_MIN_ANGLE, 0.0, 10.0, wide, 6) ==
          QSM_OK);
    CHECK(qsm_histogram_f32(tight, TORUS_VERTICES, 12, indices, TORUS_INDICES, QSM_EDGE_RATIO, 1.0, 0.5, narrow, 6) ==
          QSM_OK);
    for (k = 0; k < 6; k++) {
        total += wide[k] + narrow[k];
    }
    CHECK(total == 2 * (TORUS_INDICES / 3));
    CHECK(wide[2] > 0 && wide[3] > 0);
    CHECK(narrow[0] > 0 && narrow[1] > 0);
}

static void nothing_is_a_mesh_too(void)
{
    double lone[3] = {1.0, 2.0, 3.0};
    qsm_report report;
    qsm_measurement measured;
    qsm_report_init(&report);
    qsm_measurement_init(&measured);
    CHECK(qsm_smooth_f32(NULL, 0, 12, NULL, 0, NULL, &report) == QSM_OK);
    CHECK(report.moved == 0 && kept(&report.kept) == 0);
    CHECK(qsm_smooth_f64(lone, 1, 24, NULL, 0, NULL, &report) == QSM_OK);
    CHECK(report.kept.unreferenced == 1);
    CHECK(lone[0] == 1.0 && lone[1] == 2.0 && lone[2] == 3.0);
    CHECK(qsm_measure_f64(NULL, 0, 24, NULL, 0, &measured) == QSM_OK);
    CHECK(measured.vertices == 0 && measured.triangles == 0);
}

static void texts(void)
{
    CHECK(strcmp(qsm_version(), EXPECTED_VERSION) == 0);
    CHECK(strcmp(qsm_status_string(QSM_OK), "success") == 0);
    CHECK(strcmp(qsm_status_string(QSM_PANIC), "internal error") == 0);
    CHECK(strcmp(qsm_status_string(-1), "unknown status") == 0);
    CHECK(strcmp(qsm_status_string(QSM_PANIC + 1), "unknown status") == 0);
}

int main(void)
{
    init_functions_set_sizes();
    zeroed_outputs_are_as_good_as_initialised_ones();
    floats_of_any_stride();
    doubles_keep_the_volume();
    locked_vertices_keep_their_bits();
    marked_edges_are_features();
    options_reach_the_library();
    vertices_that_stay_are_not_written();
    progress_rises_from_0_to_1();
    measuring_agrees_with_the_report();
    histograms_count_every_triangle();
    each_triangle_has_its_quality();
    nothing_is_a_mesh_too();
    texts();
    return 0;
}
