/* A program that was built against headers in which qsm_options ended with the field user, or with triangle_mask. */
#include <qsmesh.h>

#include "check.h"
#include "torus.h"

#include <stddef.h>
#include <string.h>

typedef struct older_options {
    size_t struct_size;
    uint32_t iterations;
    qsm_plane plane;
    qsm_ideal ideal;
    qsm_boundary boundary;
    qsm_order order;
    uint32_t threads;
    double relaxation;
    double interval_width;
    double sample_limit;
    double quality_floor;
    double feature_angle;
    double max_deviation;
    const uint8_t *vertex_lock;
    const uint32_t *feature_edges;
    size_t feature_edge_count;
    qsm_flow (*progress)(double done, void *user);
    void *user;
} older_options;

/* What follows the struct in memory is the host's, and no library may touch it. */
typedef struct guarded {
    older_options options;
    unsigned char beyond[256];
} guarded;

static double positions[3 * TORUS_VERTICES], expected[3 * TORUS_VERTICES];
static uint32_t indices[TORUS_INDICES], expected_indices[TORUS_INDICES];

static const qsm_options *as_passed(const older_options *options)
{
    return (const qsm_options *)(const void *)options;
}

static void set_up(guarded *host)
{
    size_t i;
    memset(host, 0xA5, sizeof *host);
    qsm_options_init_sized((qsm_options *)(void *)&host->options, sizeof host->options);
    for (i = 0; i < sizeof host->beyond; i++) {
        CHECK(host->beyond[i] == 0xA5);
    }
    CHECK(host->options.struct_size == sizeof(older_options) && sizeof(older_options) < sizeof(qsm_options));
    CHECK(host->options.iterations == 2 && host->options.user == NULL);
}

static void start(void)
{
    torus(positions, indices);
    torus(expected, expected_indices);
}

static void smoothing_means_the_same(void)
{
    guarded host;
    qsm_options newer;
    set_up(&host);
    qsm_options_init(&newer);
    newer.iterations = host.options.iterations = 5;
    newer.feature_angle = host.options.feature_angle = 0.0;
    start();
    CHECK(qsm_smooth_f64(positions, TORUS_VERTICES, 24, indices, TORUS_INDICES, as_passed(&host.options), NULL) ==
          QSM_OK);
    CHECK(qsm_smooth_f64(expected, TORUS_VERTICES, 24, expected_indices, TORUS_INDICES, &newer, NULL) == QSM_OK);
    CHECK(memcmp(positions, expected, sizeof positions) == 0);
    newer.iterations = 2;
    start();
    CHECK(qsm_smooth_f64(expected, TORUS_VERTICES, 24, expected_indices, TORUS_INDICES, &newer, NULL) == QSM_OK);
    CHECK(qsm_smooth_f64(positions, TORUS_VERTICES, 24, indices, TORUS_INDICES, as_passed(&host.options), NULL) ==
          QSM_OK);
    CHECK(memcmp(positions, expected, sizeof positions) != 0);
}

static void fields_that_it_does_not_know_have_their_defaults(void)
{
    guarded host;
    qsm_options newer;
    size_t vertices = TORUS_VERTICES, corners = TORUS_INDICES;
    size_t expected_vertices = TORUS_VERTICES, expected_corners = TORUS_INDICES;
    set_up(&host);
    qsm_options_init(&newer);
    start();
    CHECK(qsm_improve_f64(positions, &vertices, 24, indices, &corners, as_passed(&host.options), NULL, NULL) == QSM_OK);
    CHECK(qsm_improve_f64(expected, &expected_vertices, 24, expected_indices, &expected_corners, &newer, NULL, NULL) ==
          QSM_OK);
    CHECK(vertices == expected_vertices && corners == expected_corners);
    CHECK(memcmp(positions, expected, sizeof positions) == 0);
    CHECK(memcmp(indices, expected_indices, sizeof indices) == 0);
}

/* A host that knows the tail, but no field behind triangle_mask: what stands there is its own. */
static void options_may_end_with_the_tail(void)
{
    qsm_options room, newer;
    memset(&room, 0xA5, sizeof room);
    qsm_options_init_sized(&room, offsetof(qsm_options, method));
    CHECK(room.struct_size == offsetof(qsm_options, method) && room.tail_min_angle == 20.0);
    CHECK(room.method == (qsm_method)0xA5A5A5A5 && room.visit_count != 0);
    qsm_options_init(&newer);
    newer.order = room.order = QSM_ORDER_TAIL;
    start();
    CHECK(qsm_smooth_f64(positions, TORUS_VERTICES, 24, indices, TORUS_INDICES, &room, NULL) == QSM_OK);
    CHECK(qsm_smooth_f64(expected, TORUS_VERTICES, 24, expected_indices, TORUS_INDICES, &newer, NULL) == QSM_OK);
    CHECK(memcmp(positions, expected, sizeof positions) == 0);
}

static void sizes_of_no_version_are_refused(void)
{
    guarded host;
    size_t wrong[5];
    size_t i;
    wrong[0] = 0;
    wrong[1] = sizeof(older_options) - sizeof(void *);
    wrong[2] = sizeof(older_options) + sizeof(double);
    wrong[3] = sizeof(qsm_options) + sizeof(void *);
    wrong[4] = offsetof(qsm_options, seeds);
    start();
    for (i = 0; i < 5; i++) {
        set_up(&host);
        host.options.struct_size = wrong[i];
        CHECK(qsm_smooth_f64(positions, TORUS_VERTICES, 24, indices, TORUS_INDICES, as_passed(&host.options), NULL) ==
              QSM_BAD_STRUCT_SIZE);
    }
    CHECK(memcmp(positions, expected, sizeof positions) == 0);
}

/* A struct of a newer header in front of this library: what it knows is set, and the call says that it is too old. */
static void newer_struct_is_refused_and_not_overrun(void)
{
    union {
        qsm_options known;
        unsigned char room[sizeof(qsm_options) + 64];
    } newer;
    size_t i;
    memset(&newer, 0xA5, sizeof newer);
    qsm_options_init_sized(&newer.known, sizeof(qsm_options) + 8);
    for (i = sizeof(qsm_options); i < sizeof newer.room; i++) {
        CHECK(newer.room[i] == 0xA5);
    }
    start();
    CHECK(qsm_smooth_f64(positions, TORUS_VERTICES, 24, indices, TORUS_INDICES, &newer.known, NULL) ==
          QSM_BAD_STRUCT_SIZE);
}

static void functions_without_a_size_write_version_0_1(void)
{
    qsm_options options;
    qsm_report report;
    qsm_measurement measurement;
    qsm_maps maps;
    (qsm_options_init)(&options);
    (qsm_report_init)(&report);
    (qsm_measurement_init)(&measurement);
    (qsm_maps_init)(&maps);
    CHECK(options.struct_size == sizeof options && report.struct_size == sizeof report);
    CHECK(measurement.struct_size == sizeof measurement && maps.struct_size == sizeof maps);
}

int main(void)
{
    smoothing_means_the_same();
    fields_that_it_does_not_know_have_their_defaults();
    options_may_end_with_the_tail();
    sizes_of_no_version_are_refused();
    newer_struct_is_refused_and_not_overrun();
    functions_without_a_size_write_version_0_1();
    return 0;
}
