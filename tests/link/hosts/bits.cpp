// Improves an OBJ file of nothing but vertices and triangles through the C++ header: bits IN OUT
#include <qsmesh.hpp>

#include "check.h"

#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

int main(int argc, char **argv)
{
    CHECK(argc == 3);
    std::vector<std::array<double, 3>> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::ifstream in(argv[1]);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        char kind = 0;
        words >> kind;
        if (kind == 'v') {
            auto &p = positions.emplace_back();
            CHECK(words >> p[0] >> p[1] >> p[2]);
        } else if (kind == 'f') {
            auto &t = triangles.emplace_back();
            CHECK(words >> t[0] >> t[1] >> t[2]);
            t = {t[0] - 1, t[1] - 1, t[2] - 1};
        }
    }

    qsmesh::options options;
    options.iterations = 3;
    options.feature_angle = 40;
    options.tail_min_angle = 25;
    qsmesh::improve(positions, triangles, options);

    std::ofstream out(argv[2]);
    out << std::setprecision(std::numeric_limits<double>::max_digits10);
    for (const auto &p : positions) {
        out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    }
    for (const auto &t : triangles) {
        out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    }
    CHECK(out.flush());
    return 0;
}
