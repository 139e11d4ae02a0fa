// SPDX-License-Identifier: LGPL-2.1-or-later
// The search against an independent one on random faces. The whole run:
//   UMBILIC_RANDOM_FACES=10000 umbilics_random_faces_tests --gtest_filter=*FindsWhat*
// One face: UMBILIC_FIRST_FACE=1426 UMBILIC_RANDOM_FACES=1.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>

#include <support/dense_umbilics.h>
#include <support/random_faces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

using support::SampledUmbilic;

/// Faces of a run that nobody gave a number: what ten seconds allow.
constexpr unsigned faces_by_default = 400;
/// First seed; the faces of a run are the seeds that follow.
constexpr unsigned first_by_default = 1000;

unsigned asked(const char* variable, unsigned otherwise) {
    const char* value = std::getenv(variable);
    return value ? static_cast<unsigned>(std::atoi(value)) : otherwise;
}

/// Distance in parameters, relative to the domain.
double distance(const ParameterBox& domain, const Vector2& a, const Vector2& b) {
    return std::max(std::abs(a.x() - b.x()) / domain.u.length(), std::abs(a.y() - b.y()) / domain.v.length());
}

Vector2 place(const Umbilic& umbilic) {
    return {umbilic.at.u, umbilic.at.v};
}

/// Nearer to the domain's border than this, an umbilic may be seen or not.
bool at_border(const ParameterBox& domain, const Vector2& at) {
    return std::min({(at.x() - domain.u.low) / domain.u.length(), (domain.u.high - at.x()) / domain.u.length(),
                     (at.y() - domain.v.low) / domain.v.length(), (domain.v.high - at.y()) / domain.v.length()}) <
           support::sampled_distance;
}

bool left_open(const FaceUmbilics& found, const Vector2& at) {
    const auto holds = [&](const auto& parts) {
        return std::any_of(parts.begin(), parts.end(), [&](const auto& part) {
            return std::any_of(part.boxes.begin(), part.boxes.end(),
                               [&](const ParameterBox& box) { return box.contains(at.x(), at.y()); });
        });
    };
    return holds(found.undecided) || holds(found.lines) || holds(found.regions);
}

struct Tally {
    long faces = 0, umbilics = 0, sampled = 0, matched = 0;
    long missed = 0;      ///< sampled, not found
    long left_open = 0;   ///< sampled, in a box left open
    long spurious = 0;    ///< found, and no umbilic
    long unsampled = 0;   ///< found, an umbilic, but not sampled: a miss of the independent search
    long duplicates = 0;  ///< found twice
    long wrong_index = 0;
    long far = 0;  ///< farther from the sampled one than its radius and the sampling's own accuracy
    long evaluable = 0, false_certificates = 0, open_faces = 0, open_parts = 0, unresolved = 0;
    double search_seconds = 0.0, sampling_seconds = 0.0;
};

/// Accuracy of sampled umbilics, relative to the domain: extended precision, but given in double.
constexpr double sampled_accuracy = 1e-12;

void compare(unsigned seed, Tally& tally) {
    const support::RandomFace face = support::random_face(seed);
    const NurbsSurface& surface = face.surface;
    const ParameterBox domain = surface.domain();
    const auto seconds = [start = std::chrono::steady_clock::now()] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const FaceUmbilics found = find_umbilics(surface);
    const double searched = seconds();
    const support::SampledUmbilics sampled = support::sample_umbilics(surface);
    tally.search_seconds += searched;
    tally.sampling_seconds += seconds() - searched;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + face.description);

    ++tally.faces;
    tally.unresolved += sampled.unresolved;
    tally.umbilics += static_cast<long>(found.umbilics.size());
    tally.sampled += static_cast<long>(sampled.umbilics.size());
    const std::size_t open = found.undecided.size() + found.lines.size() + found.regions.size();
    tally.open_parts += static_cast<long>(open);
    tally.open_faces += open > 0;
    if (found.certificate.complete) {
        ++tally.evaluable;
        tally.false_certificates += !*found.certificate.complete;
        EXPECT_TRUE(*found.certificate.complete) << found.certificate.why;
    }
    std::vector<int> taken(found.umbilics.size(), 0);
    for (const SampledUmbilic& one : sampled.umbilics) {
        if (at_border(domain, one.at)) continue;
        bool matched = false;
        for (std::size_t k = 0; k < found.umbilics.size(); ++k) {
            const Umbilic& umbilic = found.umbilics[k];
            const double gap = distance(domain, place(umbilic), one.at);
            if (gap > std::max(support::sampled_distance, umbilic.radius)) continue;
            matched = true;
            ++taken[k];
            if (umbilic.index != one.index) {
                ++tally.wrong_index;
                ADD_FAILURE() << "index " << umbilic.index << " instead of " << one.index << " at "
                              << one.at.transpose();
            }
            if (gap > umbilic.radius + sampled_accuracy) {
                ++tally.far;
                ADD_FAILURE() << "certified within " << umbilic.radius << " but " << gap << " off at "
                              << one.at.transpose();
            }
        }
        tally.matched += matched;
        if (matched) continue;
        if (left_open(found, one.at)) {
            ++tally.left_open;
            ADD_FAILURE() << "left open: index " << one.index << ", condition " << one.condition << " at "
                          << one.at.transpose();
        } else {
            ++tally.missed;
            ADD_FAILURE() << "missed: index " << one.index << ", condition " << one.condition << " at "
                          << one.at.transpose();
        }
    }
    for (std::size_t k = 0; k < found.umbilics.size(); ++k) {
        const Vector2 at = place(found.umbilics[k]);
        for (std::size_t other = k + 1; other < found.umbilics.size(); ++other)
            if (distance(domain, at, place(found.umbilics[other])) < support::sampled_distance) {
                ++tally.duplicates;
                ADD_FAILURE() << "twice at " << at.transpose();
            }
        if (taken[k] > 0 || at_border(domain, at)) continue;
        const std::optional<Vector2> polished = support::polished_umbilic(surface, at);
        if (polished && distance(domain, *polished, at) < support::sampled_distance) {
            ++tally.unsampled;
            ADD_FAILURE() << "the independent search missed the umbilic at " << at.transpose();
        } else {
            ++tally.spurious;
            ADD_FAILURE() << "no umbilic at " << at.transpose();
        }
    }
}

TEST(RandomFaces, FindsWhatAnIndependentSearchFinds) {
    Tally tally;
    const unsigned first = asked("UMBILIC_FIRST_FACE", first_by_default);
    for (unsigned k = 0; k < asked("UMBILIC_RANDOM_FACES", faces_by_default); ++k) compare(first + k, tally);
    std::printf(
        "faces %ld, umbilics found %ld, sampled %ld, matched %ld, missed %ld, left open %ld, spurious %ld, unsampled "
        "%ld, unresolved cells %ld, duplicates %ld, wrong index %ld, outside their radius %ld, certificates evaluable "
        "%ld, false %ld, faces "
        "with open parts %ld (%ld parts), search %.1f s, sampling %.1f s\n",
        tally.faces, tally.umbilics, tally.sampled, tally.matched, tally.missed, tally.left_open, tally.spurious,
        tally.unsampled, tally.unresolved, tally.duplicates, tally.wrong_index, tally.far, tally.evaluable,
        tally.false_certificates, tally.open_faces, tally.open_parts, tally.search_seconds, tally.sampling_seconds);
    if (tally.faces < 100) return;
    EXPECT_GT(tally.matched, tally.faces);
    EXPECT_GT(tally.evaluable, tally.faces / 2);
}

/// Weights and uneven nets make (A, B) 10^8 times smaller around some umbilics than elsewhere on their patch: one bound
/// for all coefficients hides them.
TEST(RandomFaces, ProvesUmbilicsThatTheCommonBoundHides) {
    Tally tally;
    for (const unsigned seed : {4444u, 5843u, 6695u, 8779u}) compare(seed, tally);
    EXPECT_EQ(tally.open_parts, 0);
    EXPECT_GE(tally.umbilics, 80);
}

/// How far the rounding of heights may move a planted umbilic, in parameters.
constexpr double planted_accuracy = 1e-7;

/// The independent search itself misses nothing that was planted.
TEST(RandomFaces, TheIndependentSearchFindsPlantedUmbilics) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> inside(-0.9, 0.9), turn(0.0, 6.28);
    long planted = 0, destroyed = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        std::vector<Vector2> places;
        for (int k = 0; k < 3; ++k) places.emplace_back(inside(random), inside(random));
        // Every other surface has a pair, down to 1e-3 apart.
        if (seed % 2 == 1) {
            const double gap = std::pow(10.0, -1.0 - seed % 3), angle = turn(random);
            places.push_back(places[0] + gap * Vector2(std::cos(angle), std::sin(angle)));
        }
        const NurbsSurface surface = support::with_planted_umbilics(places, seed);
        const support::SampledUmbilics sampled = support::sample_umbilics(surface);
        for (const Vector2& at : places) {
            if (at.cwiseAbs().maxCoeff() >= 1.0) continue;
            const Vector2 parameters = 0.5 * (at + Vector2::Ones());
            // Rounding of the heights moves nearly double umbilics far or lets them vanish in pairs.
            const std::optional<Vector2> exact = support::polished_umbilic(surface, parameters);
            if (!exact || (*exact - parameters).norm() > planted_accuracy) {
                ++destroyed;
                continue;
            }
            ++planted;
            double nearest = 1.0;
            for (const SampledUmbilic& one : sampled.umbilics)
                nearest = std::min(nearest, (one.at - parameters).norm());
            EXPECT_LE(nearest, planted_accuracy) << "seed " << seed << " at " << parameters.transpose();
        }
    }
    EXPECT_GT(planted, 195);
    EXPECT_LE(destroyed, 3);
}

}  // namespace
}  // namespace umbilic
