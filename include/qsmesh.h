/*
 * qsmesh: better triangles for surface meshes, with the enclosed volume kept exactly.
 *
 * Generated from the Rust sources; changes belong there.
 *
 * Needs C89 with <stdint.h>, or C++. All functions may be called from several threads at once, as the library keeps no
 * state between calls, but no memory of a call may be changed by anyone else while it runs. The caller owns every
 * buffer and struct; the library frees nothing of the caller's and returns nothing that must be freed.
 */

#ifndef QSMESH_H
#define QSMESH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Size of message in qsm_report, the final 0 byte included.
 */
#define QSM_MESSAGE_BYTES 260

/**
 * Value of offender in qsm_report where no element is to blame.
 */
#define QSM_NO_OFFENDER UINT64_MAX

/**
 * Plane into which the triangles around a vertex are projected: QSM_PLANE_VECTOR_AREA or QSM_PLANE_LEAST_SQUARES.
 */
typedef int32_t qsm_plane;

/**
 * Shape that every triangle is asked to take: QSM_IDEAL_MODELLED or QSM_IDEAL_EQUILATERAL.
 */
typedef int32_t qsm_ideal;

/**
 * What happens to vertices on the boundary of an open mesh: QSM_BOUNDARY_FIXED or QSM_BOUNDARY_SLIDE.
 */
typedef int32_t qsm_boundary;

/**
 * Order in which a sweep visits the vertices: QSM_ORDER_COLORS or QSM_ORDER_INDEX.
 */
typedef int32_t qsm_order;

/**
 * Answer of the progress callback: QSM_CONTINUE or QSM_CANCEL. Any other value counts as QSM_CANCEL.
 */
typedef int32_t qsm_flow;

/**
 * Settings of qsm_smooth_*, qsm_collapse_tails_* and qsm_improve_*. Set up with qsm_options_init, then change what
 * you like. The library keeps no pointer out of it after the call. Everything is free of scale but max_deviation.
 *
 * A host that only smooths may know this struct up to user alone, with struct_size accordingly; every field that it
 * does not know has its default then.
 *
 * The fields from tail_edge_ratio on belong to the tail, the triangles that sweeps leave bad: qsm_smooth_* does not
 * look at these fields, so nothing in them is an error there. The other calls check every field, iterations too where
 * it has no meaning.
 */
typedef struct qsm_options {
    /**
     * Size of this struct in bytes. Set by qsm_options_init; leave it alone.
     */
    size_t struct_size;
    /**
     * Sweeps over the mesh, 0 to 10000. No meaning for qsm_collapse_tails_*. Default 2.
     */
    uint32_t iterations;
    /**
     * Plane of projection. Default QSM_PLANE_VECTOR_AREA.
     */
    qsm_plane plane;
    /**
     * Shape asked of the triangles. Default QSM_IDEAL_MODELLED.
     */
    qsm_ideal ideal;
    /**
     * Treatment of boundary vertices. Default QSM_BOUNDARY_FIXED.
     */
    qsm_boundary boundary;
    /**
     * Order of the visits. Default QSM_ORDER_COLORS.
     */
    qsm_order order;
    /**
     * Threads at most, 0 to 1024; 0: as many as the machine runs at once. Small meshes stay on one. The result is the
     * same for any number. Default 0.
     */
    uint32_t threads;
    /**
     * Over-relaxation of each move, above 0 and at most 2. Default 1.2.
     */
    double relaxation;
    /**
     * Interval width of the sampling histogram in units of the edge ratio, 0.001 to 1000. Default 0.5.
     */
    double interval_width;
    /**
     * Edge ratios above this count as this, at least 1 and finite. Default 3.
     */
    double sample_limit;
    /**
     * Mean-ratio shape below which the worst triangle around a vertex may not fall or fall further, 0 to 1.
     * Default 0.5.
     */
    double quality_floor;
    /**
     * Dihedral angle in degrees above which an edge may be a crease, below 180; 0: only the edges in feature_edges are
     * features. Default 30.
     */
    double feature_angle;
    /**
     * Greatest distance of a vertex from the original surface, in the units of the coordinates, at least 0; positive
     * infinity (INFINITY or HUGE_VAL of math.h): no bound. Default infinity. A bound of 0 is a bound.
     */
    double max_deviation;
    /**
     * One byte a vertex, vertex_count in all; a vertex whose byte is not 0 keeps its bits. NULL: every vertex is free.
     * Default NULL.
     */
    const uint8_t *vertex_lock;
    /**
     * Edges to be kept as features: two vertex indices an edge, in any order, 2 * feature_edge_count in all. A pair
     * that is no edge of the mesh is ignored. May be NULL if feature_edge_count is 0. Default NULL.
     */
    const uint32_t *feature_edges;
    /**
     * Number of pairs in feature_edges. Default 0.
     */
    size_t feature_edge_count;
    /**
     * Called on the calling thread with the share of the work that is done, 0 to 1, never falling, and with user.
     * Answers QSM_CONTINUE or QSM_CANCEL. It must not throw, must not jump out, and must not change or free the memory
     * of the call. NULL: no callback. Default NULL.
     */
    qsm_flow (*progress)(double done, void *user);
    /**
     * Handed to progress as it is. Default NULL.
     */
    void *user;
    /**
     * Longest over shortest edge above which a triangle belongs to the tail, above 1 and finite. Default 3.
     */
    double tail_edge_ratio;
    /**
     * Smallest angle in degrees below which a triangle belongs to the tail, above 0 and below 60. Default 20.
     */
    double tail_min_angle;
    /**
     * Largest angle in degrees above which a triangle belongs to the tail, above 60 and below 180. Default 130.
     */
    double tail_max_angle;
    /**
     * How often one triangle is taken up at most, 1 to 1000. Default 3.
     */
    uint32_t tail_attempts;
    /**
     * 1: before the tail is treated, flip every interior edge that is no feature where the Delaunay criterion in the
     * tangent plane and the normals allow it. 0: flip edges only to cure a triangle. Default 0.
     */
    int32_t flips;
    /**
     * Operations on the tail that are carried out at most, over the whole mesh; 0: no bound. Default 0.
     */
    size_t tail_operations;
    /**
     * One byte a triangle, index_count / 3 in all; a triangle whose byte is 0 is never taken up as one of the tail,
     * but may change where a neighbour is cured. NULL: every triangle may be taken up. Default NULL.
     */
    const uint8_t *triangle_mask;
} qsm_options;

/**
 * Result of a call: one of the constants QSM_OK to QSM_PANIC. Their values never change.
 */
typedef int32_t qsm_status;

/**
 * Distribution of one quality parameter. Infinite values are counted and left out of everything else.
 */
typedef struct qsm_distribution {
    /**
     * Finite values.
     */
    size_t count;
    /**
     * Values that are not finite.
     */
    size_t infinite;
    /**
     * Mean.
     */
    double mean;
    /**
     * Variance over the count.
     */
    double variance;
    /**
     * Least value.
     */
    double min;
    /**
     * Greatest value.
     */
    double max;
    /**
     * Values at 1, 5, 25, 50, 75, 95 and 99 percent.
     */
    double percentiles[7];
} qsm_distribution;

/**
 * Quality of a mesh. Set up with qsm_measurement_init.
 */
typedef struct qsm_measurement {
    /**
     * Size of this struct in bytes. Set by qsm_measurement_init; 0, in a struct filled with zeros, stands for the
     * first version.
     */
    size_t struct_size;
    /**
     * Vertices, used or not.
     */
    size_t vertices;
    /**
     * Triangles, degenerate ones included.
     */
    size_t triangles;
    /**
     * Longest over shortest edge of a triangle.
     */
    struct qsm_distribution edge_ratio;
    /**
     * Smallest angle of a triangle, degrees.
     */
    struct qsm_distribution min_angle;
    /**
     * Largest angle of a triangle, degrees.
     */
    struct qsm_distribution max_angle;
    /**
     * Mean ratio, 4 * sqrt(3) * area / (sum of squared edges).
     */
    struct qsm_distribution shape;
    /**
     * Circumradius over twice the inradius.
     */
    struct qsm_distribution radius_ratio;
    /**
     * Triangles whose smallest angle is below 10 degrees.
     */
    size_t below_10;
    /**
     * Triangles whose smallest angle is below 20 degrees.
     */
    size_t below_20;
    /**
     * Triangles whose smallest angle is below 30 degrees.
     */
    size_t below_30;
    /**
     * Triangles without area.
     */
    size_t zero_area;
    /**
     * Edges with one triangle.
     */
    size_t boundary_edges;
    /**
     * Edges with more than two triangles, or with two that disagree in winding.
     */
    size_t non_manifold_edges;
    /**
     * Signed volume in cubed units of the coordinates: positive where the triangles turn counter-clockwise seen from
     * outside. For a mesh that is not closed, the volume of the cone from the centre of its bounding box.
     */
    double volume;
    /**
     * Sum of the areas, in squared units of the coordinates.
     */
    double area;
} qsm_measurement;

/**
 * Vertices that kept their bits, by reason. Each vertex has either moved or is counted here exactly once.
 */
typedef struct qsm_kept {
    /**
     * In no triangle.
     */
    size_t unreferenced;
    /**
     * Locked through vertex_lock.
     */
    size_t locked;
    /**
     * On a non-manifold edge or vertex, or where the winding is inconsistent.
     */
    size_t non_manifold;
    /**
     * Among triangles without area, or too few to have an inside.
     */
    size_t degenerate;
    /**
     * On a boundary that stays fixed.
     */
    size_t boundary;
    /**
     * On a corner of the features or of a sliding boundary.
     */
    size_t corner;
    /**
     * Every move that was tried would have made triangles worse.
     */
    size_t guard;
    /**
     * Every move that was tried would have passed max_deviation.
     */
    size_t deviation;
    /**
     * Already in place.
     */
    size_t settled;
} qsm_kept;

/**
 * Wall time of the library's own work, in seconds; measuring is not part of it.
 */
typedef struct qsm_seconds {
    /**
     * Everything but measuring. After qsm_collapse_tails_* the same as tail: the rest is not told apart.
     */
    double total;
    /**
     * Validation, and finding the triangles around each vertex.
     */
    double adjacency;
    /**
     * Finding features.
     */
    double features;
    /**
     * Sweeps.
     */
    double sweeps;
    /**
     * Treatment of the worst triangles; 0 where there was none.
     */
    double tail;
} qsm_seconds;

/**
 * What a call did, in figures, or why it failed. Set up with qsm_report_init; may then be used for any number of
 * calls. After a failure status, offender, offender_name and message are set and all figures are 0. A report that is
 * itself at fault (QSM_BAD_STRUCT_SIZE, or QSM_OVERLAP of the report with other memory of the call) is not written.
 */
typedef struct qsm_report {
    /**
     * Size of this struct in bytes. Set by qsm_report_init; 0, in a struct filled with zeros, stands for the first
     * version.
     */
    size_t struct_size;
    /**
     * Number of the first vertex (QSM_NON_FINITE_VERTEX), triangle (QSM_INDEX_OUT_OF_RANGE) or marked edge
     * (QSM_FEATURE_EDGE_OUT_OF_RANGE) at fault, from 0; QSM_NO_OFFENDER where no element is.
     */
    uint64_t offender;
    /**
     * Name of the argument, option or map at fault, as in this header; NULL where none is. Lives for ever.
     */
    const char *offender_name;
    /**
     * What the call returned.
     */
    qsm_status status;
    /**
     * What went wrong, in English, with the values found; ends with a 0 byte. Empty after success.
     */
    char message[QSM_MESSAGE_BYTES];
    /**
     * The mesh as it came.
     */
    struct qsm_measurement before;
    /**
     * The mesh as it left.
     */
    struct qsm_measurement after;
    /**
     * (after - before) / |before| of the signed volume; 0 for a mesh that is not closed.
     */
    double volume_relative_change;
    /**
     * Vertices that the sweeps have moved. This and all up to moves_refused tells of the sweeps alone, and is 0 after
     * qsm_collapse_tails_*, which makes none.
     */
    size_t moved;
    /**
     * Vertices that the sweeps have not moved, by reason.
     */
    struct qsm_kept kept;
    /**
     * Triangles that were left out because they name a vertex twice.
     */
    size_t skipped_triangles;
    /**
     * Edges taken as features: creases and marked edges, boundary edges not counted.
     */
    size_t feature_edges;
    /**
     * Visits, over all sweeps, in which a step was shortened.
     */
    size_t moves_halved;
    /**
     * Visits, over all sweeps, in which no step was acceptable.
     */
    size_t moves_refused;
    /**
     * Greatest distance of a moved vertex from the original surface, and of a removed one from the triangles that took
     * its place, in the units of the coordinates. Found by a local search, so never less than the true distance.
     */
    double max_deviation;
    /**
     * Where the time went.
     */
    struct qsm_seconds seconds;
    /**
     * Triangles in the tail when its treatment began. This and all that follows is 0 after qsm_smooth_*.
     */
    size_t tails_before;
    /**
     * Triangles in the tail when its treatment ended, each of them a leftover.
     */
    size_t tails_after;
    /**
     * Triangles cured by moving vertices alone.
     */
    size_t tail_moved;
    /**
     * Edges collapsed.
     */
    size_t collapsed;
    /**
     * Vertices removed whose triangles were made anew without them.
     */
    size_t removed;
    /**
     * Edges flipped to cure a triangle.
     */
    size_t flipped;
    /**
     * Edges flipped because flips was 1.
     */
    size_t general_flips;
    /**
     * Vertices that are no longer there.
     */
    size_t vertices_removed;
    /**
     * Triangles that are no longer there.
     */
    size_t triangles_removed;
    /**
     * Share of the triangles that went in which have kept their three vertices, 0 to 1.
     */
    double triangles_unchanged;
} qsm_report;

/**
 * What is wrong with a triangle: one of the constants QSM_DEFECT_DEGENERATE to QSM_DEFECT_SMALL_ANGLE.
 */
typedef int32_t qsm_defect;

/**
 * Why a triangle could not be cured: one of the constants QSM_REASON_FEATURE to QSM_REASON_NO_GAIN.
 */
typedef int32_t qsm_reason;

/**
 * A triangle that is still in the tail.
 */
typedef struct qsm_leftover {
    /**
     * Its number in the triangles that came out, from 0.
     */
    uint32_t triangle;
    /**
     * What is wrong with it.
     */
    qsm_defect defect;
    /**
     * Why it could not be cured.
     */
    qsm_reason reason;
} qsm_leftover;

/**
 * Where qsm_collapse_tails_* and qsm_improve_* write where everything came from. Set up with qsm_maps_init, then set
 * the arrays that you want; each may be NULL. How much room an array needs is told by the counts before the call; how
 * much of it is filled, by the counts after it. What lies behind that keeps its bits, and after a failure everything
 * does.
 */
typedef struct qsm_maps {
    /**
     * Size of this struct in bytes. Set by qsm_maps_init; leave it alone.
     */
    size_t struct_size;
    /**
     * For each vertex that came out, the number of the vertex that went in which it is. Rising, so that an array of
     * attributes can be brought along in place, from its first entry to its last: a[v] = a[vertex_source[v]]. Room for
     * as many numbers as vertices go in. NULL: not wanted. Default NULL.
     */
    uint32_t *vertex_source;
    /**
     * For each triangle that came out, the number of the triangle that went in whose place it took. Not always rising.
     * Room for as many numbers as triangles go in. NULL: not wanted. Default NULL.
     */
    uint32_t *triangle_source;
    /**
     * For each corner that came out (3 * triangle + 0, 1 or 2), a corner that went in (numbered likewise) of the same
     * vertex on the same side of all features, in the triangle in triangle_source if that is known to have one there.
     * Not always rising. Room for as many numbers as indices go in. NULL: not wanted. Default NULL.
     */
    uint32_t *corner_source;
    /**
     * Triangles that could not be cured, by rising number. May be NULL if leftover_capacity is 0. Default NULL.
     */
    struct qsm_leftover *leftovers;
    /**
     * Entries for which leftovers has room. Default 0.
     */
    size_t leftover_capacity;
    /**
     * Set by the call: triangles that could not be cured. May be more than leftover_capacity; then only the first
     * leftover_capacity of them are in leftovers.
     */
    size_t leftover_count;
} qsm_maps;

/**
 * A quality parameter of a triangle: one of the constants QSM_EDGE_RATIO to QSM_RADIUS_RATIO.
 */
typedef int32_t qsm_parameter;

/**
 * Success.
 */
#define QSM_OK 0

/**
 * A pointer that may not be NULL is NULL.
 */
#define QSM_NULL_POINTER 1

/**
 * struct_size was not set by the init function, or the struct comes from a newer qsmesh than the library.
 */
#define QSM_BAD_STRUCT_SIZE 2

/**
 * stride_bytes is less than three coordinates, or no multiple of the size of one.
 */
#define QSM_BAD_STRIDE 3

/**
 * A pointer is not aligned for its type.
 */
#define QSM_MISALIGNED 4

/**
 * A count is more than memory or the library can address.
 */
#define QSM_COUNT_OVERFLOW 5

/**
 * index_count is no multiple of 3.
 */
#define QSM_INDEX_COUNT 6

/**
 * A triangle names a vertex that does not exist.
 */
#define QSM_INDEX_OUT_OF_RANGE 7

/**
 * A coordinate is NaN or infinite.
 */
#define QSM_NON_FINITE_VERTEX 8

/**
 * An option or a parameter is unknown or out of its range.
 */
#define QSM_BAD_OPTION 9

/**
 * A marked feature edge names a vertex that does not exist.
 */
#define QSM_FEATURE_EDGE_OUT_OF_RANGE 10

/**
 * Memory that is written overlaps other memory of the same call.
 */
#define QSM_OVERLAP 11

/**
 * The progress callback asked to stop.
 */
#define QSM_CANCELLED 12

/**
 * Working memory could not be had.
 */
#define QSM_OUT_OF_MEMORY 13

/**
 * Defect of the library. A message stands on the standard error stream.
 */
#define QSM_PANIC 14

/**
 * Orthogonal to the vector area of the ring around the vertex: moves inside it cannot change the volume.
 */
#define QSM_PLANE_VECTOR_AREA 0

/**
 * Least-squares plane of the vertex and its neighbours. The move found in it is brought back into the volume-neutral
 * plane.
 */
#define QSM_PLANE_LEAST_SQUARES 1

/**
 * Modelled from the statistics of the triangles around the vertex.
 */
#define QSM_IDEAL_MODELLED 0

/**
 * Equilateral.
 */
#define QSM_IDEAL_EQUILATERAL 1

/**
 * They keep their bits.
 */
#define QSM_BOUNDARY_FIXED 0

/**
 * They slide along the boundary; its corners stay.
 */
#define QSM_BOUNDARY_SLIDE 1

/**
 * By colour, on all threads: no two vertices of one colour have a neighbour in common.
 */
#define QSM_ORDER_COLORS 0

/**
 * By vertex index, on one thread.
 */
#define QSM_ORDER_INDEX 1

/**
 * Go on.
 */
#define QSM_CONTINUE 0

/**
 * Stop: the call returns QSM_CANCELLED and all buffers stay as they were.
 */
#define QSM_CANCEL 1

/**
 * Longest edge over shortest edge, 1 to infinity.
 */
#define QSM_EDGE_RATIO 0

/**
 * Smallest angle in degrees, 0 to 60.
 */
#define QSM_MIN_ANGLE 1

/**
 * Largest angle in degrees, 60 to 180.
 */
#define QSM_MAX_ANGLE 2

/**
 * Mean ratio, 4 * sqrt(3) * area / (sum of squared edges), 0 to 1.
 */
#define QSM_SHAPE 3

/**
 * Circumradius over twice the inradius, 1 to infinity.
 */
#define QSM_RADIUS_RATIO 4

/**
 * It names a vertex twice, or has no area.
 */
#define QSM_DEFECT_DEGENERATE 0

/**
 * Its longest edge is too long for its shortest.
 */
#define QSM_DEFECT_NEEDLE 1

/**
 * Its largest angle is too large.
 */
#define QSM_DEFECT_CAP 2

/**
 * Its smallest angle is too small, and nothing else is wrong.
 */
#define QSM_DEFECT_SMALL_ANGLE 3

/**
 * The cure would have moved or crossed a feature.
 */
#define QSM_REASON_FEATURE 0

/**
 * The cure would have moved or removed a vertex locked through vertex_lock.
 */
#define QSM_REASON_LOCKED 1

/**
 * The cure would have moved the boundary.
 */
#define QSM_REASON_BOUNDARY 2

/**
 * The neighbourhood is no disc, or the cure would have made it none.
 */
#define QSM_REASON_TOPOLOGY 3

/**
 * The cure would have passed max_deviation.
 */
#define QSM_REASON_DEVIATION 4

/**
 * The cure would have folded the surface or bent it sharply, or left a triangle below quality_floor.
 */
#define QSM_REASON_FOLD 5

/**
 * Nothing made the worst triangle of the neighbourhood better, or tail_attempts or tail_operations was reached.
 */
#define QSM_REASON_NO_GAIN 6

/**
 * Sets struct_size to size, and every default as far as size reaches. Does nothing with NULL.
 */
void qsm_options_init_sized(struct qsm_options *options, size_t size);

/**
 * The same for the struct as it was in version 0.1, which a newer library does not exceed. C and C++ call
 * qsm_options_init_sized by this name.
 */
void qsm_options_init(struct qsm_options *options);

/**
 * Sets struct_size to size, and everything else to 0 as far as size reaches. Does nothing with NULL.
 */
void qsm_report_init_sized(struct qsm_report *report,
                           size_t size);

/**
 * qsm_report_init_sized for the struct as it was in version 0.1; as with qsm_options_init.
 */
void qsm_report_init(struct qsm_report *report);

/**
 * Sets struct_size to size, and everything else to 0 as far as size reaches. Does nothing with NULL.
 */
void qsm_measurement_init_sized(struct qsm_measurement *out,
                                size_t size);

/**
 * qsm_measurement_init_sized for the struct as it was in version 0.1; as with qsm_options_init.
 */
void qsm_measurement_init(struct qsm_measurement *out);

/**
 * Sets struct_size to size, and everything else to 0 and NULL as far as size reaches. Does nothing with NULL.
 */
void qsm_maps_init_sized(struct qsm_maps *maps,
                         size_t size);

/**
 * qsm_maps_init_sized for the struct as it was in version 0.1; as with qsm_options_init.
 */
void qsm_maps_init(struct qsm_maps *maps);

/**
 * Improves the triangles of a mesh by moving its vertices.
 *
 * positions: three coordinates x, y, z at the start of each vertex, vertices stride_bytes apart (12 for an array of
 * coordinates alone). The coordinates of moved vertices are changed in place, but only after everything has
 * succeeded; bytes between the coordinates of one vertex and the next are neither read nor written. May be NULL if
 * vertex_count is 0.
 * indices: three vertex numbers a triangle, consistently wound; index_count counts the numbers, not the triangles.
 * Never changed. May be NULL if index_count is 0.
 * options: NULL for the defaults. report: NULL if not wanted; measuring is then left out too.
 *
 * Returns QSM_OK, or another status; then no position has changed, and the report says what is at fault. Bad elements
 * (triangles without area, non-manifold edges, unused vertices) are no error: they are left alone and counted.
 *
 * All arithmetic is in double precision; a result is rounded once to the precision of the buffer. The enclosed volume
 * of a closed mesh stays as it is but for that rounding. The same input gives the same result.
 */
qsm_status qsm_smooth_f32(float *positions,
                          size_t vertex_count,
                          size_t stride_bytes,
                          const uint32_t *indices,
                          size_t index_count,
                          const struct qsm_options *options,
                          struct qsm_report *report);

/**
 * The same as qsm_smooth_f32 for coordinates in double precision (stride_bytes is 24 for an array of coordinates
 * alone).
 */
qsm_status qsm_smooth_f64(double *positions,
                          size_t vertex_count,
                          size_t stride_bytes,
                          const uint32_t *indices,
                          size_t index_count,
                          const struct qsm_options *options,
                          struct qsm_report *report);

/**
 * Cures the triangles that no smoothing can help, because the edges between the vertices force their shape: moves
 * vertices, flips edges, collapses them and removes vertices, worst triangle first. The mesh may come out with
 * fewer vertices and triangles than went in.
 *
 * positions: as for qsm_smooth_f32. *vertex_count is the number of vertices that go in, and after success the
 * number of those that came out. The coordinates of these are moved up, in their old order, to the first places;
 * the bytes between the coordinates of one vertex and the next are neither read nor written, so other attributes of
 * a vertex stay in their old places until the caller brings them along through vertex_source of maps.
 * indices: as for qsm_smooth_f32, but changed in place. *index_count is the number of indices that go in, and after
 * success of those that came out. Triangles that were not touched keep their vertices, order and winding.
 * In both buffers, what lies behind the new count keeps its bits. Neither count may be NULL.
 * options: NULL for the defaults. maps: NULL if not wanted. report: NULL if not wanted; measuring is then left out
 * too.
 *
 * Returns QSM_OK, or another status; then buffers, counts and maps are as they were, and the report says what is at
 * fault. A triangle that could not be cured is no error, but listed in maps with the reason.
 *
 * Features and the boundary stay, and locked vertices keep their bits. The enclosed volume of a closed mesh stays as
 * it is but for rounding to the precision of the buffer. The same input gives the same result.
 */
qsm_status qsm_collapse_tails_f32(float *positions,
                                  size_t *vertex_count,
                                  size_t stride_bytes,
                                  uint32_t *indices,
                                  size_t *index_count,
                                  const struct qsm_options *options,
                                  struct qsm_maps *maps,
                                  struct qsm_report *report);

/**
 * The same as qsm_collapse_tails_f32 for coordinates in double precision.
 */
qsm_status qsm_collapse_tails_f64(double *positions,
                                  size_t *vertex_count,
                                  size_t stride_bytes,
                                  uint32_t *indices,
                                  size_t *index_count,
                                  const struct qsm_options *options,
                                  struct qsm_maps *maps,
                                  struct qsm_report *report);

/**
 * qsm_smooth_f32, and then qsm_collapse_tails_f32 for what is left, in one call with the parameters of the latter.
 * Features, deviations and the original surface are those of the mesh that went in; before, after, max_deviation and
 * volume_relative_change in the report are those of the whole call.
 */
qsm_status qsm_improve_f32(float *positions,
                           size_t *vertex_count,
                           size_t stride_bytes,
                           uint32_t *indices,
                           size_t *index_count,
                           const struct qsm_options *options,
                           struct qsm_maps *maps,
                           struct qsm_report *report);

/**
 * The same as qsm_improve_f32 for coordinates in double precision.
 */
qsm_status qsm_improve_f64(double *positions,
                           size_t *vertex_count,
                           size_t stride_bytes,
                           uint32_t *indices,
                           size_t *index_count,
                           const struct qsm_options *options,
                           struct qsm_maps *maps,
                           struct qsm_report *report);

/**
 * Measures the quality of a mesh. Buffers are as for qsm_smooth_f32 and are not changed; out must have been set up
 * with qsm_measurement_init and is written only if the call returns QSM_OK.
 */
qsm_status qsm_measure_f32(const float *positions,
                           size_t vertex_count,
                           size_t stride_bytes,
                           const uint32_t *indices,
                           size_t index_count,
                           struct qsm_measurement *out);

/**
 * The same as qsm_measure_f32 for coordinates in double precision.
 */
qsm_status qsm_measure_f64(const double *positions,
                           size_t vertex_count,
                           size_t stride_bytes,
                           const uint32_t *indices,
                           size_t index_count,
                           struct qsm_measurement *out);

/**
 * Counts how many triangles have a value of parameter in each interval of width interval from lower on. Values below
 * lower go into the first bin; values past the last bin, infinite ones too, into the last. Buffers are as for
 * qsm_smooth_f32 and are not changed.
 *
 * interval must be above 0, lower finite and bin_count at least 1, else the status is QSM_BAD_OPTION. counts has room
 * for bin_count numbers, which are overwritten, and only if the call returns QSM_OK.
 */
qsm_status qsm_histogram_f32(const float *positions,
                             size_t vertex_count,
                             size_t stride_bytes,
                             const uint32_t *indices,
                             size_t index_count,
                             qsm_parameter parameter,
                             double lower,
                             double interval,
                             size_t *counts,
                             size_t bin_count);

/**
 * The same as qsm_histogram_f32 for coordinates in double precision.
 */
qsm_status qsm_histogram_f64(const double *positions,
                             size_t vertex_count,
                             size_t stride_bytes,
                             const uint32_t *indices,
                             size_t index_count,
                             qsm_parameter parameter,
                             double lower,
                             double interval,
                             size_t *counts,
                             size_t bin_count);

/**
 * Writes the value of parameter for each triangle to values, which has room for index_count / 3 numbers: infinite where
 * a triangle without area has none that is finite. Buffers are as for qsm_smooth_f32 and are not changed; values is
 * overwritten only if the call returns QSM_OK.
 */
qsm_status qsm_triangle_quality_f32(const float *positions,
                                    size_t vertex_count,
                                    size_t stride_bytes,
                                    const uint32_t *indices,
                                    size_t index_count,
                                    qsm_parameter parameter,
                                    double *values);

/**
 * The same as qsm_triangle_quality_f32 for coordinates in double precision.
 */
qsm_status qsm_triangle_quality_f64(const double *positions,
                                    size_t vertex_count,
                                    size_t stride_bytes,
                                    const uint32_t *indices,
                                    size_t index_count,
                                    qsm_parameter parameter,
                                    double *values);

/**
 * English text for a status; "unknown status" for any other number. Never NULL, lives for ever, not to be freed.
 */
const char *qsm_status_string(qsm_status status);

/**
 * Version of the library at run time, such as "1.2.3". Never NULL, lives for ever, not to be freed.
 */
const char *qsm_version(void);

/*
 * The init functions know how much room the caller's struct has, which is that of this header and not of the library
 * that is found at run time.
 */
#define qsm_options_init(options) qsm_options_init_sized((options), sizeof(qsm_options))
#define qsm_report_init(report) qsm_report_init_sized((report), sizeof(qsm_report))
#define qsm_measurement_init(out) qsm_measurement_init_sized((out), sizeof(qsm_measurement))
#define qsm_maps_init(maps) qsm_maps_init_sized((maps), sizeof(qsm_maps))

#ifdef __cplusplus
}
#endif

#endif /* QSMESH_H */
