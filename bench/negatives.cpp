// SPDX-License-Identifier: LGPL-2.1-or-later
// Every ordered pair of different objects among the given files, compared: none may be called derived.
// negatives [--every-version] FILE...
// Files of one family (their names agree up to the first '_' or '.') are versions of one object: they are not paired,
// and of each family the first file alone takes part unless --every-version is given.
// Prints the pairs whose verdict is not "none" or whose alignment is more than "not found", and a table of counts;
// progress goes to standard error.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <occ_adapter/read_file.h>
#include <umbilic/core/errors.h>
#include <umbilic/similarity/compare.h>

using namespace umbilic;

namespace {

struct Entry {
    std::string name, family;
    Model model;
    std::unique_ptr<PreparedModel> prepared;
};

std::string family_of(const std::string& name) {
    return name.substr(0, name.find_first_of("_."));
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::unique_ptr<Entry>> entries;
    const bool every_version = argc > 1 && std::string(argv[1]) == "--every-version";
    for (int i = every_version ? 2 : 1; i < argc; ++i) {
        const std::string name = std::filesystem::path(argv[i]).filename().string();
        const auto of_family = [&](const auto& entry) { return entry->family == family_of(name); };
        if (!every_version && std::any_of(entries.begin(), entries.end(), of_family)) continue;
        try {
            auto entry = std::make_unique<Entry>(Entry{name, family_of(name), read_file(argv[i]).model, nullptr});
            entry->prepared = std::make_unique<PreparedModel>(prepare(entry->model));
            entries.push_back(std::move(entry));
        } catch (const Error& error) {
            std::printf("left out: %s\n", error.what());
        }
    }
    std::map<std::string, int> levels, statuses;
    std::size_t expected = 0;
    for (const auto& original : entries)
        expected += std::count_if(entries.begin(), entries.end(),
                                  [&](const auto& suspect) { return original->family != suspect->family; });
    std::size_t pairs = 0, derived = 0;
    double slowest = 0.0, total = 0.0;
    std::string slowest_pair;
    for (const auto& original : entries)
        for (const auto& suspect : entries) {
            if (original->family == suspect->family) continue;
            const auto start = std::chrono::steady_clock::now();
            const Comparison comparison = compare(*original->prepared, *suspect->prepared);
            const double seconds = seconds_since(start);
            total += seconds;
            if (seconds > slowest) {
                slowest = seconds;
                slowest_pair = original->name + " / " + suspect->name;
            }
            ++pairs;
            derived += comparison.verdict.derived;
            const std::string level = name(comparison.verdict.level), status = name(comparison.alignment.status);
            ++levels[level];
            ++statuses[status];
            if (comparison.verdict.level != Level::none || comparison.alignment.status == AlignmentStatus::found)
                std::printf("%s / %s: %s, %s; %s\n", original->name.c_str(), suspect->name.c_str(), level.c_str(),
                            status.c_str(), comparison.alignment.why.c_str());
            std::fflush(stdout);
            std::fprintf(stderr, "%zu of %zu pairs, %.2f s: %s / %s\n", pairs, expected, seconds,
                         original->name.c_str(), suspect->name.c_str());
        }
    std::printf("%zu files, %zu ordered pairs of different objects, %zu derived; %.2f s a pair, slowest %.1f s (%s)\n",
                entries.size(), pairs, derived, pairs ? total / pairs : 0.0, slowest, slowest_pair.c_str());
    for (const auto& [level, count] : levels) std::printf("level %s: %d\n", level.c_str(), count);
    for (const auto& [status, count] : statuses) std::printf("alignment %s: %d\n", status.c_str(), count);
    return derived == 0 ? 0 : 1;
}
