// Times the peers on one mesh: processor|wall MESH FOLDER REPETITIONS PEER... They take turns; each line that is printed
// is one turn: name, iterations, seconds of adjacency and of smoothing, separated by tabs. The positions after two
// iterations go to FOLDER. Without arguments it lists the peers.
#include "peer.hpp"

#include <algorithm>
#include <ctime>
#include <cstdio>
#include <stdexcept>

namespace {

constexpr unsigned FEW = 2, MANY = 6;
// A turn that takes longer than this is not repeated as often.
constexpr double SLOW = 0.5;

std::vector<Entry> all_entries() {
    std::vector<Entry> all;
    for (const auto& part : {plain_entries(), qsmesh_entries(), openmesh_entries(), cgal_entries()}) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

// Seconds on the clock that was asked for. Processor time, of all threads, leaves out what else the machine does.
clockid_t chosen = CLOCK_MONOTONIC;

double now() {
    timespec time;
    clock_gettime(chosen, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <typename Work>
double seconds(Work work) {
    const double start = now();
    work();
    return now() - start;
}

double turn(const Entry& entry, const Mesh& mesh, const std::string& folder, unsigned iterations) {
    const std::unique_ptr<Peer> peer = entry.build(mesh);
    const double connecting = seconds([&] { peer->connect(); });
    const double smoothing = seconds([&] { peer->smooth(iterations); });
    std::printf("%s\t%u\t%.9f\t%.9f\n", entry.name.c_str(), iterations, connecting, smoothing);
    if (iterations == FEW) write_positions(folder + "/" + entry.name + ".positions", peer->positions());
    return smoothing;
}

void compare(const Mesh& mesh, const std::string& folder, int repetitions, const std::vector<std::string>& names) {
    std::vector<Entry> entries;
    for (const Entry& entry : all_entries()) {
        if (std::find(names.begin(), names.end(), entry.name) != names.end()) entries.push_back(entry);
    }
    if (entries.size() != names.size()) throw std::runtime_error("a peer has a name that is not known");
    std::vector<bool> slow(entries.size(), false);
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (slow[i]) continue;
            for (const unsigned iterations : {FEW, MANY}) {
                if (turn(entries[i], mesh, folder, iterations) > SLOW) slow[i] = true;
            }
        }
    }
}

} // namespace

int main(int count, char** arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    if (words.empty()) {
        for (const Entry& entry : all_entries()) std::puts(entry.name.c_str());
        return 0;
    }
    try {
        if (words.size() < 5) throw std::runtime_error("arguments: processor|wall MESH FOLDER REPETITIONS PEER...");
        chosen = words[0] == "processor" ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
        compare(read_mesh(words[1]), words[2], std::stoi(words[3]), {words.begin() + 4, words.end()});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
