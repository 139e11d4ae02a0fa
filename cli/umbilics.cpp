// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <memory>
#include <string>

#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>

#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/lines_and_regions_text.h>
#include <cli/loading.h>
#include <report/json.h>
#include <report/json_geometry.h>
#include <report/readable.h>

namespace umbilic {

namespace {

std::string complex_text(const std::optional<std::complex<double>>& value) {
    if (!value) return "-";
    return readable(value->real()) + (value->imag() < 0.0 ? " − " : " + ") + readable(std::abs(value->imag())) + "i";
}

std::string certificate_text(const Certificate& certificate) {
    std::string text = !certificate.complete   ? "completeness "
                       : *certificate.complete ? "complete: "
                                               : "not complete: ";
    text += certificate.why;
    return text;
}

std::string face_line(const Face& face, const FaceUmbilics& found) {
    std::string text = "Face " + std::to_string(face.number) + " (" + name(face.kind) +
                       "): " + readable_count(found.umbilics.size()) + " isolated, " +
                       readable_count(found.lines.size()) + " lines, " + readable_count(found.regions.size()) +
                       " regions, " + readable_count(found.undecided.size()) + " undecided; " +
                       certificate_text(found.certificate) + "\n";
    return text;
}

std::string type_text(const Umbilic& umbilic) {
    const UmbilicClass& kind = umbilic.kind;
    std::string text = kind.star == StarKind::none ? "" : std::string(name(kind.star)) + " ";
    text += name(kind.type);
    if (umbilic.pole != PoleKind::none) text += ", pole";
    return text;
}

std::string umbilic_table(const Model& model, const std::vector<FaceUmbilics>& all) {
    std::vector<std::vector<std::string>> rows;
    for (const FaceUmbilics& found : all) {
        const Face& face = model.face(found.face);
        for (const Umbilic& umbilic : found.umbilics) {
            const Vector2 native = native_parameters(face, umbilic.at.u, umbilic.at.v);
            rows.push_back({std::to_string(face.number), readable(native.x(), 8), readable(native.y(), 8),
                            type_text(umbilic), readable(umbilic.kappa), complex_text(umbilic.kind.omega),
                            readable(umbilic.index, 2), umbilic.certified ? "yes" : "no",
                            umbilic.containment == Containment::outside ? "no" : "yes"});
        }
    }
    if (rows.empty()) return "";
    return "\n" + table({"face", "u", "v", "type", "κ 1/mm", "ω", "index", "proved", "inside"}, rows, {0, 1, 2, 4, 6});
}

}  // namespace

void add_umbilics(CLI::App& application, Session& session, Command& command) {
    struct Options {
        std::string path;
        int face = 0;
        UmbilicOptions search;
    };
    auto* const subcommand =
        application.add_subcommand("umbilics", "Every umbilic of every face, with proofs and certificates");
    const auto options = std::make_shared<Options>();
    subcommand->add_option("FILE", options->path, "STEP, IGES or BREP file")->required();
    subcommand->add_option("--face", options->face, "Only this face, from 1")->check(CLI::PositiveNumber);
    subcommand
        ->add_option("--tolerance,--umbilic_resolution", options->search.resolution,
                     "Side of the smallest box of the search, relative to the domain")
        ->check(CLI::PositiveNumber);
    subcommand->add_option("--umbilic_boxes", options->search.boxes_per_patch, "Boxes the search may use on a patch")
        ->check(CLI::PositiveNumber);
    subcommand
        ->add_option("--umbilic_margin", options->search.generic_margin,
                     "Relative error of the cubic forms that is assumed on top of rounding")
        ->check(CLI::NonNegativeNumber);
    subcommand
        ->add_option("--accuracy,--umbilic_accuracy", options->search.accuracy,
                     "How far (mm) control points may be from where they should be: types that this changes are "
                     "called non-generic")
        ->check(CLI::NonNegativeNumber);
    subcommand
        ->add_option("--umbilic_recognition", options->search.recognition,
                     "Deviation from a plane or sphere, relative to a face's size, within which it is umbilic "
                     "everywhere; 0 finds the umbilics of its ripples")
        ->check(CLI::NonNegativeNumber);
    add_common_options(*subcommand, session);
    subcommand->callback([&session, &command, options] {
        command = [&session, options] {
            const Progress& progress = session.progress;
            const ReadResult read = load(session, options->path, {}, progress.part(0.0, 0.4));
            const Model& model = read.model;
            std::vector<FaceUmbilics> found;
            if (options->face > 0) {
                const auto face = std::find_if(model.faces.begin(), model.faces.end(), [&](const Face& candidate) {
                    return candidate.number == options->face;
                });
                if (face == model.faces.end()) {
                    throw WrongUse(options->path + ": has no face " + std::to_string(options->face) +
                                   "; umbilic info lists its faces");
                }
                found.push_back(find_umbilics(*face, options->search, progress.part(0.4, 1.0)));
            } else {
                found = find_umbilics(model, options->search, progress.part(0.4, 1.0));
            }
            clear_progress_bar();
            std::string text = bold(printable(options->path)) + "\n";
            for (const FaceUmbilics& on_face : found) text += face_line(model.face(on_face.face), on_face);
            print(session, text + umbilic_table(model, found) + lines_and_regions_text(model, found));
            write_json(session, umbilics_json(model, found));
            return exit_done;
        };
    });
}

}  // namespace umbilic
