// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_analytic_faces.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include <umbilic/matching/analytic_constraints.h>
#include <umbilic/matching/pose_distance.h>
#include <umbilic/matching/tolerances.h>

namespace umbilic {

namespace {

/// Angles (radians) and ratios of lengths that may correspond: above the noise of recognised NURBS faces; what differs
/// by less than this is told apart by the refinement.
constexpr double same_angle = 1e-3, same_ratio = 2e-3;
/// Largest residual of the equations of a basis, and distance at which a feature still lies on another one, as parts of
/// the moved suspect's length.
constexpr double same_place = 3e-3;
/// Bases of the suspect that are tried until one pose explains `explained` of its analytic area.
constexpr int most_bases = 12;
constexpr double explained = 0.95;
/// A pose that explains less of it, or less than half of what the best one does, is dropped.
constexpr double least_explained = 0.1, of_the_best = 0.5;
/// Assignments of one feature that are looked at before the search gives up, poses kept while it runs, and handed on.
constexpr long most_steps = 3'000'000;
constexpr std::size_t most_kept = 5000, most_proposals = 400;
/// Scale by which the moved suspect's length may differ from the original's.
constexpr double greatest_length_ratio = 50.0;
/// Factor by which a scale may leave the user's range and still be tried.
constexpr double scale_slack = 1.0 + same_ratio;
/// Ways in which an undetermined pose is filled in: turns about the only direction, places on a face.
constexpr int free_turns = 12, free_places = 4;
constexpr std::size_t most_filled = 600;
/// Share of a model's area on planes, cylinders, cones, spheres and tori from which it is made of nothing else.
constexpr double only_elementary = 0.99;

struct ExplainedPose {
    SimilarityTransform pose;
    double share = 0.0;  ///< soft share of the analytic area that finds its feature
};

/// What is made of outward sides and of the sense of planes' normals.
enum class Sides {
    as_stated,  ///< they correspond
    reversed,   ///< all of one model are to be turned over
    ignored
};

/// Everything that lays the features of one model (the one that is moved) on those of another one.
class FeatureSearch {
public:
    FeatureSearch(const PreparedModel& ground, const PreparedModel& moved, const ScaleChoice& scale,
                  MirrorChoice mirror, Sides sides, const Progress& progress)
        : ground_(ground),
          moved_(moved.features.analytic),
          scale_(scale),
          mirrored_too_(mirror == MirrorChoice::automatic),
          sides_(sides),
          ground_length_(shape_size(ground.features).length),
          moved_length_(shape_size(moved.features).length),
          progress_(progress) {
        for (AnalyticFeature& feature : moved_) {
            if (sides == Sides::reversed) {
                feature.side = -feature.side;
                if (feature.kind == SurfaceKind::plane) feature.direction = -feature.direction;
            }
            area_ += feature.area;
            std::vector<int>& own = partners_.emplace_back();
            for (int i = 0; i < static_cast<int>(ground.features.analytic.size()); ++i)
                if (alike(feature, ground.features.analytic[i])) own.push_back(i);
        }
    }

    void run() {
        std::vector<int> counts;
        for (const std::vector<int>& own : partners_) counts.push_back(static_cast<int>(own.size()));
        const std::vector<AnalyticBasis> bases =
            choose_bases(moved_, counts, scale_.kind == ScaleChoice::Kind::fixed, most_bases);
        determined = !bases.empty() && bases.front().determined;
        for (std::size_t k = 0; k < bases.size() && !exhausted; ++k) {
            if (bases[k].determined != determined) continue;
            progress_.report(static_cast<double>(k) / bases.size(), "matching analytic faces");
            basis_ = &bases[k];
            pairs_.clear();
            assign(0, 0.0, true, mirrored_too_);
            fill_in();
            if (best_ >= explained || !determined) break;
        }
        keep_best(most_kept);
    }

    double best() const { return best_; }

    std::vector<ExplainedPose> poses;  ///< best first
    bool determined = false;           ///< the features fix the pose
    bool exhausted = false;            ///< the search gave up before its end

private:
    bool signed_direction(const AnalyticFeature& feature) const {
        return feature.kind == SurfaceKind::cone || (feature.kind == SurfaceKind::plane && sides_ != Sides::ignored);
    }

    void keep_best(std::size_t count) {
        std::stable_sort(poses.begin(), poses.end(),
                         [](const ExplainedPose& a, const ExplainedPose& b) { return a.share > b.share; });
        if (poses.size() > count) poses.resize(count);
    }

    /// True if two features may be the same one in some similarity.
    bool alike(const AnalyticFeature& a, const AnalyticFeature& b) const {
        if (a.kind != b.kind || (sides_ != Sides::ignored && a.side != b.side)) return false;
        const double error = angle_error(a) + angle_error(b);
        return std::abs(a.semi_angle - b.semi_angle) <= same_angle + error &&
               std::abs(a.minor_radius * b.radius - b.minor_radius * a.radius) <=
                   (same_ratio + error) * a.radius * b.radius;
    }

    static double angle_error(const AnalyticFeature& a) { return a.error > 0.0 ? a.error / a.extent : 0.0; }

    static double angle(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

    bool angles_agree(const FeaturePair& pair) const {
        if (!pair.suspect->has_direction()) return true;
        for (const FeaturePair& other : pairs_) {
            if (!other.suspect->has_direction()) continue;
            const double here = angle(pair.suspect->direction, other.suspect->direction);
            const double there = angle(pair.sense * pair.original->direction, other.sense * other.original->direction);
            const double error = angle_error(*pair.suspect) + angle_error(*other.suspect) +
                                 angle_error(*pair.original) + angle_error(*other.original);
            if (std::abs(here - there) > same_angle + error) return false;
        }
        return true;
    }

    bool scale_possible(double scale) const {
        const double ratio = scale * moved_length_ / ground_length_;
        return scale > 0.0 && ratio < greatest_length_ratio && ratio * greatest_length_ratio > 1.0 &&
               scale_.allows(scale, scale_slack);
    }

    PlacingStart start_for(double scale) const {
        return {scale > 0.0 ? scale : scale_.clamp(ground_length_ / moved_length_), pairs_.front().suspect->point,
                pairs_.front().original->point};
    }

    /// Assigns the feature number `depth` of the basis in every way that fits those before it. `scale`: from radii, 0
    /// if not yet known; hands that are still possible.
    void assign(std::size_t depth, double scale, bool proper, bool mirrored) {
        if (depth == basis_->features.size()) {
            if (determined)
                keep_solved(scale, proper, mirrored);
            else
                open_.push_back({pairs_, scale});
            return;
        }
        const int own = basis_->features[depth];
        const AnalyticFeature& feature = moved_[own];
        for (const int other : partners_[own]) {
            if (++steps_ > most_steps) exhausted = true;
            if (exhausted) return;
            if (steps_ % 1024 == 0) progress_.check();
            const AnalyticFeature& target = ground_.features.analytic[other];
            double own_scale = scale;
            if (feature.has_radius()) {
                own_scale = target.radius / feature.radius;
                const double slack = same_ratio + feature.error / feature.radius + target.error / target.radius;
                if (scale > 0.0 ? std::abs(own_scale / scale - 1.0) > slack : !scale_possible(own_scale)) continue;
                if (scale > 0.0) own_scale = scale;
            }
            const bool either = feature.has_direction() && !signed_direction(feature);
            for (const double sense : {1.0, -1.0}) {
                if (sense < 0.0 && !either) break;
                const FeaturePair pair{&feature, &target, sense};
                if (!angles_agree(pair)) continue;
                pairs_.push_back(pair);
                bool hands[2] = {proper, mirrored};
                check_places(own_scale, hands);
                if (hands[0] || hands[1]) assign(depth + 1, own_scale, hands[0], hands[1]);
                pairs_.pop_back();
            }
        }
    }

    /// Crosses out the hands for which the equations of the pairs so far contradict each other.
    void check_places(double scale, bool (&hands)[2]) const {
        if (pairs_.size() < 2) return;
        const std::vector<Matrix3> maps = orthogonal_maps(pairs_, moved_length_, hands[1]);
        for (std::size_t hand = 0; hand < maps.size(); ++hand) {
            if (!hands[hand]) continue;
            const FeaturePose pose = place(pairs_, maps[hand], start_for(scale), moved_length_, scale_);
            const double found = std::abs(pose.original_suspect.scale);
            hands[hand] = pose.residual <= same_place * found * moved_length_;
        }
    }

    void keep_solved(double scale, bool proper, bool mirrored) {
        const std::vector<Matrix3> maps = orthogonal_maps(pairs_, moved_length_, mirrored);
        for (std::size_t hand = 0; hand < maps.size(); ++hand) {
            if (hand == 0 && !proper) continue;
            const FeaturePose pose = place(pairs_, maps[hand], start_for(scale), moved_length_, scale_);
            keep(pose.original_suspect);
        }
    }

    void keep(const SimilarityTransform& pose) {
        if (!scale_possible(pose.scale)) return;
        const double share = explained_by(pose, std::max(least_explained, of_the_best * best_));
        if (share < std::max(least_explained, of_the_best * best_)) return;
        best_ = std::max(best_, share);
        poses.push_back({pose, share});
        if (poses.size() == 2 * most_kept) keep_best(most_kept);
    }

    /// Largest of the differences of a moved feature from one of the ground, each over what is allowed; 1 or more if
    /// they are different features.
    double difference(const AnalyticFeature& feature, const SimilarityTransform& pose, const Vector3& direction,
                      const AnalyticFeature& target) const {
        const double place = same_place * pose.scale * moved_length_ + pose.scale * feature.error + target.error;
        double worst = 0.0;
        if (feature.has_radius()) {
            const double radius = same_ratio * target.radius + pose.scale * feature.error + target.error;
            worst = std::abs(pose.scale * feature.radius - target.radius) / radius;
            if (worst >= 1.0) return worst;
        }
        if (feature.has_direction()) {
            double cosine = direction.dot(target.direction);
            if (!signed_direction(feature)) cosine = std::abs(cosine);
            const double allowed = 2.0 * same_angle + angle_error(feature) + angle_error(target);
            if (!(cosine > 0.0)) return 1.0;
            worst = std::max(worst, direction.cross(target.direction).norm() / allowed);
            if (worst >= 1.0) return worst;
        }
        if (feature.kind == SurfaceKind::extrusion) return worst;
        const Vector3 apart = pose.apply(feature.point) - target.point;
        double distance = 0.0;
        if (feature.has_centre())
            distance = apart.norm();
        else if (feature.kind == SurfaceKind::plane)
            distance = std::abs(apart.dot(target.direction));
        else
            distance = (apart - apart.dot(target.direction) * target.direction).norm();
        return std::max(worst, distance / place);
    }

    /// Share of the moved model's analytic area whose features lie on features of the ground, less the worse they fit;
    /// abandoned as soon as it cannot reach `at_least`.
    double explained_by(const SimilarityTransform& pose, double at_least) const {
        double sum = 0.0, left = area_;
        for (std::size_t i = 0; i < partners_.size(); ++i) {
            if (sum + left < at_least * area_) return 0.0;
            const AnalyticFeature& feature = moved_[i];
            const Vector3 direction = pose.apply_direction(feature.direction);
            double least = 1.0;
            for (const int other : partners_[i])
                least = std::min(least, difference(feature, pose, direction, ground_.features.analytic[other]));
            sum += feature.area * (1.0 - least * least);
            left -= feature.area;
        }
        return sum / area_;
    }

    /// Poses for assignments that do not fix one: what is open is set to some values of many, the assignments that
    /// explain most first, so that every assignment gets its first pose before any gets its second.
    void fill_in() {
        for (OpenAssignment& open : open_) {
            progress_.check();
            pairs_ = open.pairs;
            for (const SimilarityTransform& pose : filled_in(open.scale, place_on(*pairs_.front().original, 0), 1))
                open.share = std::max(open.share, explained_by(pose, 0.0));
        }
        std::stable_sort(open_.begin(), open_.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
        for (int k = 0; k <= free_places; ++k)
            for (const OpenAssignment& open : open_) {
                if (poses.size() >= most_filled) return;
                progress_.check();
                pairs_ = open.pairs;
                for (const SimilarityTransform& pose :
                     filled_in(open.scale, place_on(*pairs_.front().original, k), free_turns))
                    keep(pose);
            }
    }

    /// What the pairs leave open filled in with one place, the likely scales, and so many turns.
    std::vector<SimilarityTransform> filled_in(double scale, const Vector3& image, int turns) const {
        std::vector<double> scales = {scale};
        if (scale == 0.0) {
            scales = {scale_.clamp(1.0)};
            // A piece of about the size of the feature on which it lies.
            const double fitting = pairs_.front().original->extent / pairs_.front().suspect->extent;
            if (scale_possible(fitting)) scales.push_back(fitting);
        }
        const Vector3 point = pairs_.front().suspect->middle;
        std::vector<SimilarityTransform> result;
        for (const double s : scales)
            for (const Matrix3& map : open_maps(turns))
                result.push_back(place(pairs_, map, {s, point, image}, moved_length_, scale_).original_suspect);
        return result;
    }

    /// The middle of a feature of the ground, and from 1 on points spread over its faces.
    Vector3 place_on(const AnalyticFeature& feature, int which) const {
        if (which == 0) return feature.middle;
        std::vector<Vector3> samples;
        for (const AreaSample& sample : ground_.features.samples)
            if (std::count(feature.faces.begin(), feature.faces.end(), sample.at.face) > 0)
                samples.push_back(sample.curvature.point);
        return samples[(2 * which - 1) * samples.size() / (2 * free_places)];
    }

    /// Orthogonal maps that agree with the pairs' directions, turned in so many steps where they leave a turn open.
    std::vector<Matrix3> open_maps(int turns) const {
        std::vector<Matrix3> maps = orthogonal_maps(pairs_, moved_length_, mirrored_too_);
        if (!maps.empty()) return maps;
        Matrix3 first = Matrix3::Identity();
        Vector3 axis = Vector3::UnitZ();
        for (const FeaturePair& pair : pairs_)
            if (pair.suspect->has_direction()) {
                axis = pair.sense * pair.original->direction;
                first = Eigen::Quaterniond::FromTwoVectors(pair.suspect->direction, axis).toRotationMatrix();
                break;
            }
        for (int k = 0; k < turns; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / turns;
            maps.push_back(Eigen::AngleAxisd(angle, axis).toRotationMatrix() * first);
        }
        return maps;
    }

    const PreparedModel& ground_;
    std::vector<AnalyticFeature> moved_;
    ScaleChoice scale_;
    bool mirrored_too_;
    Sides sides_;
    double ground_length_;
    double moved_length_;
    const Progress& progress_;
    std::vector<std::vector<int>> partners_;  ///< by feature of the moved model: those of the ground it may lie on
    double area_ = 0.0;
    const AnalyticBasis* basis_ = nullptr;
    std::vector<FeaturePair> pairs_;
    /// A basis that is assigned and leaves motions open.
    struct OpenAssignment {
        std::vector<FeaturePair> pairs;
        double scale = 0.0;
        double share = 0.0;  ///< what its first pose explains
    };
    std::vector<OpenAssignment> open_;
    long steps_ = 0;
    double best_ = 0.0;
};

bool made_of_elementary_faces(const Features& features) {
    double area = 0.0, elementary_area = 0.0;
    for (const AreaSample& sample : features.samples) area += sample.weight;
    for (const AnalyticFeature& feature : features.analytic)
        if (elementary(feature.kind)) elementary_area += feature.area;
    return elementary_area >= only_elementary * area;
}

std::vector<PoseHypothesis> different_poses(std::vector<ExplainedPose> found, const PoseDistance& distance) {
    std::stable_sort(found.begin(), found.end(),
                     [](const ExplainedPose& a, const ExplainedPose& b) { return a.share > b.share; });
    std::vector<PoseHypothesis> result;
    for (const ExplainedPose& pose : found) {
        if (result.size() == most_proposals) break;
        const auto near = [&](const PoseHypothesis& other) {
            return distance.relative(pose.pose, other.original_suspect) < same_pose;
        };
        if (std::none_of(result.begin(), result.end(), near)) result.push_back({pose.pose, MatchMethod::analytic});
    }
    return result;
}

}  // namespace

Proposals poses_by_analytic_faces(const PreparedModel& original, const PreparedModel& suspect, const ScaleChoice& scale,
                                  MirrorChoice mirror, const Progress& progress) {
    const std::size_t of_original = original.features.analytic.size(), of_suspect = suspect.features.analytic.size();
    Proposals result{.why = "analytic faces (" + std::to_string(of_original) + " of the original, " +
                            std::to_string(of_suspect) + " of the suspect)"};
    if (of_original == 0 || of_suspect == 0) return result;

    // Open shells are mostly turned the same way throughout; what their faces say is tried before it is ignored.
    std::vector<Sides> readings = {Sides::as_stated};
    if (!(original.model.oriented() && suspect.model.oriented()))
        readings = {Sides::as_stated, Sides::reversed, Sides::ignored};
    std::vector<ExplainedPose> found;
    double best = 0.0;
    bool determined = false, exhausted = false;
    // If the suspect is not explained, it holds foreign material, or more than the original, whose features may then
    // all be there.
    for (const bool swapped : {false, true}) {
        if (best >= explained) break;
        double best_here = 0.0;
        for (const Sides sides : readings) {
            if (sides == Sides::ignored && best_here >= explained) break;
            FeatureSearch search(swapped ? suspect : original, swapped ? original : suspect,
                                 swapped ? scale.inverse() : scale, mirror, sides, progress);
            search.run();
            best_here = std::max(best_here, search.best());
            exhausted = exhausted || search.exhausted;
            determined = determined || (search.determined && !swapped);
            if (!search.determined && search.best() < explained) continue;
            for (const ExplainedPose& pose : search.poses)
                found.push_back({swapped ? pose.pose.inverse() : pose.pose, pose.share});
        }
        best = std::max(best, best_here);
    }
    result.open = !determined;
    result.conclusive = !exhausted && made_of_elementary_faces(suspect.features) &&
                        (best >= explained || made_of_elementary_faces(original.features));
    result.poses = different_poses(std::move(found), PoseDistance(suspect.features));
    result.why += result.poses.empty() ? " proposed no pose"
                                       : " proposed " + std::to_string(result.poses.size()) + " pose" +
                                             (result.poses.size() > 1 ? "s" : "");
    if (!determined) result.why += ", the suspect's leaving a motion free";
    if (exhausted) result.why += ", the search cut short";
    return result;
}

}  // namespace umbilic
