/* Improves a small mesh that comes out smaller, and brings its vertex colours and face materials along:
   cc improve.c -lqsmesh */
#include <qsmesh.h>
#include <stdio.h>

enum { VERTICES = 7, TRIANGLES = 10 };

int main(void)
{
    /* An octahedron. Vertex 0 sits on one of its faces, where it makes three flat triangles. */
    double positions[3 * VERTICES] = {0.5, 0.3, 0.2, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    uint32_t indices[3 * TRIANGLES] = {1, 3, 0, 3, 5, 0, 5, 1, 0, 3, 2, 5, 2, 4, 5,
                                       4, 1, 5, 3, 1, 6, 2, 3, 6, 4, 2, 6, 1, 4, 6};
    const char *colours[VERTICES] = {"grey", "red", "green", "blue", "white", "black", "pink"};
    int materials[TRIANGLES] = {7, 7, 7, 1, 2, 3, 4, 5, 6, 8};
    int new_materials[TRIANGLES];
    uint32_t vertex_source[VERTICES], triangle_source[TRIANGLES];
    qsm_leftover leftovers[4];
    size_t vertex_count = VERTICES, index_count = 3 * TRIANGLES, i;
    qsm_options options;
    qsm_maps maps;
    qsm_report report;
    qsm_status status;

    qsm_options_init(&options);
    qsm_report_init(&report);
    qsm_maps_init(&maps);
    options.tail_max_angle = 110.0;
    maps.vertex_source = vertex_source;
    maps.triangle_source = triangle_source;
    maps.leftovers = leftovers;
    maps.leftover_capacity = 4;
    status = qsm_improve_f64(positions, &vertex_count, 3 * sizeof(double), indices, &index_count, &options, &maps,
                             &report);
    if (status != QSM_OK) {
        fprintf(stderr, "%s: %s\n", qsm_status_string(status), report.message);
        return 1;
    }
    printf("%d -> %lu vertices, %d -> %lu triangles, %lu left that could not be cured\n", VERTICES,
           (unsigned long)vertex_count, TRIANGLES, (unsigned long)(index_count / 3),
           (unsigned long)maps.leftover_count);

    /* vertex_source rises, so vertices can be brought along in place; triangle_source may not. */
    for (i = 0; i < vertex_count; i++) {
        colours[i] = colours[vertex_source[i]];
        printf("vertex %lu: %5.2f %5.2f %5.2f, %s\n", (unsigned long)i, positions[3 * i], positions[3 * i + 1],
               positions[3 * i + 2], colours[i]);
    }
    for (i = 0; i < index_count / 3; i++) {
        new_materials[i] = materials[triangle_source[i]];
        printf("triangle %lu: %lu %lu %lu, material %d\n", (unsigned long)i, (unsigned long)indices[3 * i],
               (unsigned long)indices[3 * i + 1], (unsigned long)indices[3 * i + 2], new_materials[i]);
    }
    return 0;
}
