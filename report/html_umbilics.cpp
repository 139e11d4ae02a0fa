// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/html_sections.h>

#include <algorithm>

#include <report/json_geometry.h>
#include <report/readable.h>

namespace umbilic {

namespace {

/// Umbilics that are printed for each model; all are in result.json.
constexpr std::size_t most_rows = 60;

std::string omega_text(const UmbilicClass& kind) {
    if (!kind.omega) return "–";
    const double imaginary = kind.omega->imag();
    return readable(kind.omega->real()) + (imaginary < 0.0 ? " − " : " + ") + readable(std::abs(imaginary)) + "i";
}

std::string type_text(const UmbilicClass& kind) {
    return kind.star == StarKind::none ? name(kind.type) : std::string(name(kind.star)) + " " + name(kind.type);
}

/// One row; the partner and its distance are empty where there is none.
PageData umbilic_row(const LocatedUmbilic& located, const std::string& label, const std::string& partner,
                     const std::string& distance) {
    const auto& [face, umbilic] = located;
    const Vector2 native = native_parameters(*face, umbilic->at.u, umbilic->at.v);
    PageData row;
    row.set("label", label);
    row.set("face", std::to_string(face->number));
    row.set("u", readable(native.x(), 6));
    row.set("v", readable(native.y(), 6));
    row.set("type", type_text(umbilic->kind));
    row.set("omega", omega_text(umbilic->kind));
    row.set("kappa", readable(umbilic->kappa) + (umbilic->flat ? " (flat)" : ""));
    row.set("certified", umbilic->certified ? "proved" : "not proved");
    row.set("partner", partner);
    row.set("distance", distance);
    return row;
}

std::string search_text(const PreparedShape& shape) {
    if (!shape.model()) return "measured points, in which no umbilics are searched";
    const PreparedModel& prepared = *shape.model();
    std::size_t isolated = 0, lines = 0, regions = 0, undecided = 0, complete = 0, incomplete = 0;
    for (const FaceUmbilics& found : prepared.features.umbilics) {
        isolated += found.umbilics.size();
        lines += found.lines.size();
        regions += found.regions.size();
        undecided += found.undecided.size();
        complete += found.certificate.complete.value_or(false) ? 1 : 0;
        incomplete += found.certificate.complete.value_or(true) ? 0 : 1;
    }
    std::string text = readable_count(isolated) + " isolated on untrimmed surfaces, " + readable_count(lines) +
                       " lines, " + readable_count(regions) + " regions, " + readable_count(undecided) +
                       " places undecided; completeness proved on " + readable_count(complete) + " of " +
                       readable_count(prepared.features.umbilics.size()) + " faces";
    if (incomplete > 0) text += ", disproved on " + readable_count(incomplete);
    return text;
}

}  // namespace

void set_umbilics(const ReportInput& input, PageData& page) {
    const StrongTest& strong = input.comparison.assessment.strong;
    const auto originals = isolated_umbilics(input.original);
    const auto suspects = isolated_umbilics(input.suspect);
    PageData rows{PageData::type::list};
    const auto add = [&](bool of_suspect) {
        const auto& located = of_suspect ? suspects : originals;
        for (std::size_t i = 0; i < std::min(most_rows, located.size()); ++i) {
            const auto pair = std::find_if(strong.pairs.begin(), strong.pairs.end(), [&](const UmbilicPair& candidate) {
                return (of_suspect ? candidate.suspect : candidate.original) == static_cast<int>(i);
            });
            const bool paired = pair != strong.pairs.end();
            const std::string partner =
                paired ? (of_suspect ? "O" : "S") + std::to_string((of_suspect ? pair->original : pair->suspect) + 1)
                       : "";
            rows.push_back(umbilic_row(located[i], (of_suspect ? "S" : "O") + std::to_string(i + 1), partner,
                                       paired ? readable(pair->distance, "mm") : ""));
        }
    };
    add(false);
    add(true);
    page.set("umbilics", rows);
    page.set("has_umbilic_table", !originals.empty() || !suspects.empty());
    page.set("umbilics_left_out", originals.size() > most_rows || suspects.size() > most_rows);
    page.set("strong_why", strong.why);
    page.set("strong_passed", strong.passed ? (*strong.passed ? "passed" : "not passed") : "not applicable");
    page.set("original_search", search_text(input.original));
    page.set("suspect_search", search_text(input.suspect));
}

}  // namespace umbilic
