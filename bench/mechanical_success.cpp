// SPDX-License-Identifier: LGPL-2.1-or-later
// Success matrix of matching mechanical parts: pieces cut out by a random ball, in unknown places, scales and hands.
// mechanical_success [--cases N] [--only TEXT] [--coverage PERCENT] [--analytic] [--foreign] [--verbose]
//   --cases N    cases a cell (default 30)
//   --only TEXT  parts whose name contains TEXT
//   --coverage P pieces of that share of the area only: 100, 60, 30 or 10
//   --analytic   this method alone; otherwise all of them, as the command does
//   --foreign    half of every suspect's area is a foreign part beside the piece
//   --verbose    a line for every case that is not as it should be
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <tbb/global_control.h>

#include <occ_adapter/shape_to_model.h>
#include <umbilic/core/errors.h>
#include <umbilic/matching/match.h>
#include <umbilic/matching/pose_distance.h>

#include "measurements.h"
#include "mechanical_parts.h"

using namespace umbilic;
using namespace umbilic::bench;

namespace {

constexpr std::array<double, 4> coverages = {1.0, 0.6, 0.3, 0.1};

/// A motion by a tenth of the length that changes distances by less than 1e-5 of it leaves a piece undetermined.
constexpr double undetermined = 1e-4;

struct Arguments {
    int cases = 30;
    int percent = 0;  ///< 0: all coverages
    std::string only;
    bool foreign = false, verbose = false;
    MatchOptions match;
};

/// A model with its features; stays in place because the features refer to it.
struct Prepared {
    Model model;
    std::unique_ptr<PreparedModel> features;
};

std::unique_ptr<Prepared> prepared(const TopoDS_Shape& shape, int samples) {
    auto result = std::make_unique<Prepared>();
    result->model = shape_to_model(shape);
    FeatureOptions options;
    options.umbilics.certificate = false;
    options.samples.count = samples;
    options.table_samples = 5 * samples;
    result->features = std::make_unique<PreparedModel>(prepare(result->model, options));
    return result;
}

struct Original {
    MechanicalPart part;
    std::unique_ptr<Prepared> prepared;
};

struct Trial {
    std::unique_ptr<Prepared> suspect;
    SimilarityTransform truth;  ///< suspect to original
    int own_faces = 0;          ///< the first faces of the suspect, which come from the original
    bool determined = false;
};

bool is_determined(const std::vector<AreaSample>& samples) {
    const ShapeSize size = shape_size(samples);
    Eigen::Matrix<double, 7, 7> sum = Eigen::Matrix<double, 7, 7>::Zero();
    double weight = 0.0;
    for (const AreaSample& sample : samples) {
        const Vector3 arm = 2.0 * (sample.curvature.point - size.centroid) / size.length;
        const Vector3& normal = sample.curvature.normal;
        Eigen::Matrix<double, 7, 1> row;
        row << arm.cross(normal), normal, normal.dot(arm);
        sum += sample.weight * row * row.transpose();
        weight += sample.weight;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(sum / weight, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0.0, solver.eigenvalues()[0])) > undetermined;
}

std::vector<AreaSample> own_samples(const Trial& trial) {
    std::vector<AreaSample> samples = trial.suspect->features->features.samples;
    std::erase_if(samples, [&](const AreaSample& sample) { return sample.at.face > trial.own_faces; });
    return samples;
}

Trial make_trial(const Original& original, double coverage, const Original* foreign, std::mt19937_64& random) {
    const auto& samples = original.prepared->features->features.samples;
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    TopoDS_Shape piece = original.part.shape;
    if (coverage < 1.0) {
        const Vector3 centre = samples[random() % samples.size()].curvature.point;
        std::vector<std::pair<double, double>> distances;
        double total = 0.0;
        for (const AreaSample& sample : samples) {
            distances.emplace_back((sample.curvature.point - centre).norm(), sample.weight);
            total += sample.weight;
        }
        std::sort(distances.begin(), distances.end());
        double sum = 0.0;
        std::size_t k = 0;
        while (k + 1 < distances.size() && (sum += distances[k].second) < coverage * total) ++k;
        piece = inside_ball(piece, centre, distances[k].first);
    }
    Trial trial;
    trial.own_faces = face_count(piece);
    if (foreign) piece = with_neighbour(piece, foreign->part.shape);
    const double size = original.prepared->model.size();
    trial.truth.scale = std::exp(uniform(-std::log(20.0), std::log(20.0)));
    trial.truth.mirrored = random() % 2 == 1;
    Eigen::Quaterniond turn(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    trial.truth.rotation = turn.normalized().toRotationMatrix();
    trial.truth.translation = 3.0 * size * Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    trial.suspect = prepared(moved(piece, trial.truth.inverse()), 1000);
    trial.determined = is_determined(own_samples(trial));
    return trial;
}

/// Largest distance of the moved suspect from the original / sqrt(area) below 0.01 and the scale within 2 %: a place
/// where the original repeats is as right as the one the piece was cut from.
bool right(const Original& original, const Trial& trial, const SimilarityTransform& pose) {
    if (std::abs(pose.scale / trial.truth.scale - 1.0) > 0.02) return false;
    const double limit = 0.01 * original.prepared->model.size();
    for (const AreaSample& sample : own_samples(trial)) {
        const auto closest = original.prepared->features->tree.closest(pose.apply(sample.curvature.point), limit);
        if (!closest || closest->distance > limit) return false;
    }
    return true;
}

struct Cell {
    int determined = 0, success = 0, found = 0, undetermined = 0, named = 0, false_found = 0, negatives = 0,
        false_negatives = 0;
    std::vector<double> seconds;

    void add(const Cell& other) {
        determined += other.determined, success += other.success, found += other.found;
        undetermined += other.undetermined, named += other.named, false_found += other.false_found;
        negatives += other.negatives, false_negatives += other.false_negatives;
        seconds.insert(seconds.end(), other.seconds.begin(), other.seconds.end());
    }
};

Cell run_cell(const std::vector<Original>& originals, std::size_t which, double coverage, const Arguments& arguments) {
    Cell cell;
    const Original& original = originals[which];
    for (int k = 0; k < arguments.cases; ++k) {
        std::mt19937_64 random(1000003ull * k + static_cast<std::uint64_t>(1000 * coverage) + 17 * which);
        // Another part, not the same one stored otherwise.
        std::size_t other = which;
        do other = random() % originals.size();
        while (originals[other].part.name.substr(0, 5) == original.part.name.substr(0, 5));
        const Trial trial = make_trial(original, coverage, arguments.foreign ? &originals[other] : nullptr, random);
        const auto start = std::clock();
        const Alignment alignment = match(*original.prepared->features, *trial.suspect->features, arguments.match);
        cell.seconds.push_back(seconds_since(start));
        bool correct =
            alignment.status != AlignmentStatus::not_found && right(original, trial, alignment.original_suspect);
        for (const SimilarityTransform& other : alignment.symmetries)
            correct = correct || right(original, trial, other);
        const bool named = alignment.status == AlignmentStatus::compatible && !alignment.free_motions.empty();
        (trial.determined ? cell.determined : cell.undetermined) += 1;
        if (trial.determined) cell.success += correct, cell.found += correct && alignment.found();
        if (!trial.determined) cell.named += named;
        const bool false_found = alignment.found() && !correct;
        cell.false_found += false_found;

        if (arguments.foreign) {
            // The foreign part is in the suspect: a third one is asked.
            const std::string there = originals[other].part.name.substr(0, 5);
            do other = (other + 1) % originals.size();
            while (originals[other].part.name.substr(0, 5) == original.part.name.substr(0, 5) ||
                   originals[other].part.name.substr(0, 5) == there);
        }
        ++cell.negatives;
        const Alignment negative =
            match(*originals[other].prepared->features, *trial.suspect->features, arguments.match);
        cell.false_negatives += negative.found();
        if (arguments.verbose && (false_found || (trial.determined ? !correct : !named)))
            std::printf("  case %d of %s, %s: %s, %s\n", k, original.part.name.c_str(),
                        trial.determined ? "determined" : "undetermined", name(alignment.status),
                        alignment.why.c_str());
        if (arguments.verbose &&
            (negative.found() || negative.suspect_coverage >= 0.95 || negative.original_coverage >= 0.95))
            std::printf("  case %d of %s %s on %s: %s\n", k, original.part.name.c_str(), name(negative.status),
                        originals[other].part.name.c_str(), negative.why.c_str());
    }
    return cell;
}

void print(const std::string& name, double coverage, const Cell& cell) {
    const auto percent = [](int part, int all) { return all == 0 ? 0.0 : 100.0 * part / all; };
    std::printf("%-18s %4.0f%% %5d %9.1f %8.1f %6d %7.1f %7d %8d of %-4d %8.3f %8.3f\n", name.c_str(), 100 * coverage,
                cell.determined, percent(cell.success, cell.determined), percent(cell.found, cell.determined),
                cell.undetermined, percent(cell.named, cell.undetermined), cell.false_found, cell.false_negatives,
                cell.negatives, median(cell.seconds), *std::max_element(cell.seconds.begin(), cell.seconds.end()));
    std::fflush(stdout);
}

void run(const Arguments& arguments) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    std::vector<MechanicalPart> parts = made_parts();
    const std::filesystem::path files = std::filesystem::path(UMBILIC_SHARED_CAD_DIR) / "mechanical";
    for (const auto& [file, name, count] :
         {std::tuple("as1_assembly_inch_ap203.stp", "as1", 2), std::tuple("nist_mbe_pmi_2.stp", "nist_mbe_pmi_2", 1)}) {
        if (!std::filesystem::exists(files / file)) continue;
        for (MechanicalPart& part : parts_of_file((files / file).string(), name, count)) parts.push_back(part);
    }
    std::vector<Original> originals;
    for (MechanicalPart& part : parts) {
        auto model = prepared(part.shape, 4000);
        std::printf("%s: %zu faces, %zu features; ", part.name.c_str(), model->model.faces.size(),
                    model->features->features.analytic.size());
        originals.push_back({std::move(part), std::move(model)});
    }
    std::printf("\n%d cases a cell, one thread; scale 1/20 to 20, either hand\n", arguments.cases);
    std::printf("%-18s %5s %5s %9s %8s %6s %7s %7s %16s %8s %8s\n", "part", "cover", "det.", "success %", "found %",
                "undet.", "named %", "wrong", "false on others", "median s", "worst s");
    for (const double coverage : coverages) {
        if (arguments.percent != 0 && std::lround(100 * coverage) != arguments.percent) continue;
        Cell all;
        for (std::size_t i = 0; i < originals.size(); ++i) {
            if (originals[i].part.name.find(arguments.only) == std::string::npos) continue;
            const Cell cell = run_cell(originals, i, coverage, arguments);
            print(originals[i].part.name, coverage, cell);
            all.add(cell);
        }
        if (!all.seconds.empty()) print("all", coverage, all);
    }
}

Arguments read_arguments(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool more = i + 1 < argc;
        if (word == "--verbose")
            arguments.verbose = true;
        else if (word == "--foreign")
            arguments.foreign = true;
        else if (word == "--analytic")
            arguments.match.method = MethodChoice::analytic;
        else if (word == "--cases" && more)
            arguments.cases = std::max(1, std::atoi(argv[++i]));
        else if (word == "--coverage" && more)
            arguments.percent = std::atoi(argv[++i]);
        else if (word == "--only" && more)
            arguments.only = argv[++i];
        else
            throw InvalidInput("mechanical_success: unknown word " + word);
    }
    return arguments;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(read_arguments(argc, argv));
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
