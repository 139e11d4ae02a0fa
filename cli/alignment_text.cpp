// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/alignment_text.h>

#include <numbers>

#include <Eigen/Geometry>

#include <report/given_pairs_text.h>
#include <report/readable.h>

namespace umbilic {

std::vector<std::pair<std::string, std::string>> alignment_facts(const Alignment& alignment) {
    const auto joined = [](const Vector3& vector) {
        return "(" + readable(vector.x(), 6) + ", " + readable(vector.y(), 6) + ", " + readable(vector.z(), 6) + ")";
    };
    std::vector<std::pair<std::string, std::string>> lines = {{"Alignment", name(alignment.status)},
                                                              {"", alignment.why}};
    if (!alignment.given_pairs.empty()) lines.emplace_back("  pairs", given_pairs_text(alignment.given_pairs));
    if (alignment.status == AlignmentStatus::not_found) return lines;
    const SimilarityTransform& pose = alignment.original_suspect;
    const Eigen::AngleAxisd turn(pose.rotation);
    lines.emplace_back("  by", std::string(name(alignment.method)) + ", " + name(alignment.scope));
    lines.emplace_back("  scale", readable(pose.scale, 8) + (pose.mirrored ? ", mirrored" : ""));
    lines.emplace_back("  rotation",
                       readable(turn.angle() * 180.0 / std::numbers::pi, 6) + "° about " + joined(turn.axis()));
    lines.emplace_back("  translation", joined(pose.translation) + " mm");
    lines.emplace_back("  distance", "rms " + readable(alignment.rms, "mm", 3) + ", max " +
                                         readable(alignment.max, "mm", 3) + ", relative max " +
                                         readable(alignment.relative_max, 3));
    for (const FreeMotion& motion : alignment.free_motions) lines.emplace_back("  free", in_words(motion));
    return lines;
}

}  // namespace umbilic
