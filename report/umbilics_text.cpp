// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/umbilics_text.h>

#include <algorithm>
#include <cmath>

#include <report/readable.h>

namespace umbilic {

namespace {

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& words, const char* last = " and ") {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 < words.size() ? ", " : last) + words[i];
    return text;
}

/// Of what kind the whole face is, by its file or recognised.
SurfaceKind whole_kind(const Face& face, const FaceUmbilics& found) {
    return found.recognised ? found.recognised->kind : face.kind;
}

bool umbilic_everywhere(const Face& face, const FaceUmbilics& found) {
    const SurfaceKind kind = whole_kind(face, found);
    return kind == SurfaceKind::plane || kind == SurfaceKind::sphere;
}

}  // namespace

UmbilicCounts count_umbilics(const Model& model, const std::vector<FaceUmbilics>& all) {
    UmbilicCounts counts;
    counts.faces = all.size();
    for (const FaceUmbilics& found : all) {
        if (umbilic_everywhere(model.face(found.face), found)) {
            ++counts.whole;
            continue;
        }
        for (const Umbilic& umbilic : found.umbilics) {
            if (umbilic.containment == Containment::outside) {
                ++counts.outside;
                continue;
            }
            ++counts.isolated;
            switch (umbilic.kind.type) {
                case UmbilicType::star:
                    ++counts.stars;
                    break;
                case UmbilicType::monstar:
                    ++counts.monstars;
                    break;
                case UmbilicType::lemon:
                    ++counts.lemons;
                    break;
                case UmbilicType::non_generic:
                    ++counts.non_generic;
                    break;
            }
        }
        for (const UmbilicLine& line : found.lines) counts.lines += line.containment == Containment::outside ? 0 : 1;
        counts.regions += found.regions.size();
        counts.undecided += found.undecided.size();
        counts.complete += found.certificate.complete.value_or(false) ? 1 : 0;
        counts.incomplete += found.certificate.complete.value_or(true) ? 0 : 1;
    }
    return counts;
}

std::string umbilics_headline(const UmbilicCounts& counts) {
    if (counts.isolated == 0) return "no isolated umbilic";
    std::vector<std::string> kinds;
    if (counts.stars > 0) kinds.push_back(counted(counts.stars, "star"));
    if (counts.monstars > 0) kinds.push_back(counted(counts.monstars, "monstar"));
    if (counts.lemons > 0) kinds.push_back(counted(counts.lemons, "lemon"));
    if (counts.non_generic > 0) kinds.push_back(readable_count(counts.non_generic) + " non-generic");
    return counted(counts.isolated, "isolated umbilic") + ": " + listed(kinds);
}

std::string umbilics_explanation(const UmbilicCounts& counts) {
    std::vector<std::string> sentences;
    const std::size_t searched = counts.faces - counts.whole;
    const std::size_t open = searched - counts.complete - counts.incomplete;
    const auto faces = [&](std::size_t count) {
        return readable_count(count) + (counts.whole > 0 ? " other" : "") + (count == 1 ? " face" : " faces");
    };
    const std::string all =
        searched == 1 ? (counts.whole > 0 ? "the other face" : "the face") : "all of the " + faces(searched);
    if (counts.whole > 0)
        sentences.push_back((counts.whole == 1 ? "1 face is a plane or a sphere"
                                               : readable_count(counts.whole) + " faces are planes or spheres") +
                            ": every point is an umbilic.");
    if (searched > 0 && searched == counts.complete)
        sentences.push_back((counts.isolated + counts.outside + counts.lines + counts.regions + counts.undecided == 0
                                 ? "It is proved that there is none on "
                                 : "The list is proved to be complete on ") +
                            all + ".");
    else if (searched > 0 && searched == open)
        sentences.push_back("The list could not be proved to be complete on " +
                            (searched == 1 ? all : "any of the " + faces(searched)) + ".");
    else if (searched > 0) {
        sentences.push_back("The list is proved to be complete on " + readable_count(counts.complete) + " of " +
                            faces(searched) + ".");
        if (open > 0) sentences.push_back("On " + readable_count(open) + " that could not be proved.");
    }
    if (counts.incomplete > 0)
        sentences.push_back("On " + counted(counts.incomplete, "face") + " the list is known not to be complete.");

    std::vector<std::string> more;
    if (counts.lines > 0) more.push_back(counted(counts.lines, "line") + " of umbilics");
    if (counts.regions > 0) more.push_back(counted(counts.regions, "region") + " on which every point is an umbilic");
    if (counts.undecided > 0) more.push_back(counted(counts.undecided, "place") + " that could not be decided");
    if (counts.outside > 0)
        more.push_back(counted(counts.outside, "umbilic") + " of the untrimmed surfaces outside of the faces");
    if (!more.empty()) {
        const bool one = counts.lines + counts.regions + counts.undecided + counts.outside == 1;
        sentences.push_back(std::string("There ") + (one ? "is " : "are ") + (counts.isolated > 0 ? "also " : "") +
                            listed(more) + ".");
    }
    std::string text;
    for (const std::string& sentence : sentences) text += (text.empty() ? "" : " ") + sentence;
    return text;
}

std::string certificate_words(const FaceUmbilics& found) {
    const Certificate& certificate = found.certificate;
    if (!certificate.complete) return "completeness " + certificate.why;
    if (!*certificate.complete) return "not complete: " + certificate.why;
    if (!found.undecided.empty())
        return "complete but for the undecided places: every other umbilic of this face is listed; proved";
    std::vector<std::string> besides;
    if (!found.lines.empty()) besides.push_back(found.lines.size() == 1 ? "the line" : "the lines");
    if (!found.regions.empty()) besides.push_back(found.regions.size() == 1 ? "the region" : "the regions");
    const std::string except = besides.empty() ? "" : "besides " + listed(besides) + " ";
    return found.umbilics.empty() ? "complete: " + except + "there is no umbilic; proved"
                                  : "complete: " + except + "every umbilic of this face is listed; proved";
}

std::string type_words(const Umbilic& umbilic) {
    return class_words(umbilic.kind) + (umbilic.pole != PoleKind::none ? ", at a pole" : "") +
           (umbilic.flat ? ", flat" : "");
}

std::string class_words(const UmbilicClass& kind) {
    if (const std::optional<GenericType> type = generic_type(kind.type, kind.star)) return name(*type);
    std::vector<std::string> names;
    for (const GenericType type : kind.neighbours) names.emplace_back(name(type));
    constexpr std::size_t all_types = 4;
    if (names.size() == all_types) return std::string(name(kind.type)) + ": any type";
    return name(kind.type) + (names.empty() ? "" : ": " + listed(names, " or "));
}

std::string omega_words(const UmbilicClass& kind) {
    if (!kind.omega) return "∞";
    const double imaginary = kind.omega->imag();
    return readable(kind.omega->real()) + (imaginary < 0.0 ? " − " : " + ") + readable(std::abs(imaginary)) + "i";
}

bool worth_showing(const Face& face, const FaceUmbilics& found) {
    return !found.umbilics.empty() || !found.undecided.empty() || !found.lines.empty() ||
           (!found.regions.empty() && !umbilic_everywhere(face, found));
}

std::vector<FaceGroup> plain_faces(const Model& model, const std::vector<FaceUmbilics>& all) {
    std::vector<FaceGroup> groups;
    for (const FaceUmbilics& found : all) {
        const Face& face = model.face(found.face);
        if (worth_showing(face, found)) continue;
        std::string words = certificate_words(found);
        if (umbilic_everywhere(face, found))
            words = std::string(whole_kind(face, found) == SurfaceKind::plane ? "planes" : "spheres") +
                    (found.recognised ? ", recognised as such" : "") + ": every point is an umbilic";
        auto group = std::ranges::find(groups, words, &FaceGroup::words);
        if (group == groups.end()) group = groups.insert(groups.end(), {words, {}});
        group->faces.push_back(face.number);
    }
    return groups;
}

std::string shell_words(const ShellCertificate& shell) {
    std::string text = shell.closed ? "closed" : "open";
    if (const std::optional<int> genus = shell.genus()) text += ", genus " + std::to_string(*genus);
    if (!shell.complete) return text + "; completeness " + shell.why;
    const std::string sum = "the indices of its umbilics sum to " + readable(shell.index_sum, 3);
    if (!*shell.complete)
        return text + "; not complete: " + sum + " instead of " + readable(*shell.euler_characteristic, 3);
    return text + "; complete: " + sum + ", Euler's characteristic";
}

std::vector<ShellGroup> shell_groups(const std::vector<ShellCertificate>& shells) {
    std::vector<ShellGroup> groups;
    for (const ShellCertificate& shell : shells) {
        const std::string words = shell_words(shell);
        auto group = std::ranges::find(groups, words, &ShellGroup::words);
        if (group == groups.end()) group = groups.insert(groups.end(), {words, 0, {}});
        ++group->shells;
        group->faces.insert(group->faces.end(), shell.faces.begin(), shell.faces.end());
    }
    for (ShellGroup& group : groups) std::ranges::sort(group.faces);
    return groups;
}

std::string number_ranges(const std::vector<int>& numbers) {
    std::string text;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
        text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
        if (last > i) text += (last == i + 1 ? ", " : "–") + std::to_string(numbers[last]);
        i = last + 1;
    }
    return text;
}

std::string counted(std::size_t count, const std::string& noun) {
    return readable_count(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace umbilic
