#include "mesh.hpp"

#include <fstream>
#include <stdexcept>

namespace {

template <typename T>
void read_all(std::ifstream& file, std::vector<T>& values, std::uint64_t count) {
    values.resize(count);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

} // namespace

Mesh read_mesh(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::uint64_t counts[2] = {0, 0};
    file.read(reinterpret_cast<char*>(counts), sizeof counts);
    Mesh mesh;
    read_all(file, mesh.positions, 3 * counts[0]);
    read_all(file, mesh.triangles, 3 * counts[1]);
    if (!file) throw std::runtime_error(path + " holds no mesh");
    return mesh;
}

void write_positions(const std::string& path, const std::vector<double>& positions) {
    std::ofstream file(path, std::ios::binary);
    const auto bytes = static_cast<std::streamsize>(positions.size() * sizeof(double));
    file.write(reinterpret_cast<const char*>(positions.data()), bytes);
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}
