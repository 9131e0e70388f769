/* Smooths a small mesh in place: cc smooth.c -lqsmesh */
#include <qsmesh.h>
#include <stdio.h>

int main(void)
{
    /* A pyramid whose bottom, in four triangles, has its middle vertex off the middle. */
    float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 1, 0.6f, 0.5f, 0};
    uint32_t indices[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5};
    qsm_options options;
    qsm_report report;
    qsm_status status;

    qsm_options_init(&options);
    qsm_report_init(&report);
    options.iterations = 4;
    status = qsm_smooth_f32(positions, 6, 3 * sizeof(float), indices, 24, &options, &report);
    if (status != QSM_OK) {
        fprintf(stderr, "%s: %s\n", qsm_status_string(status), report.message);
        return 1;
    }
    printf("%lu vertices moved, longest over shortest edge %.2f -> %.2f on average\n", (unsigned long)report.moved,
           report.before.edge_ratio.mean, report.after.edge_ratio.mean);
    return 0;
}
