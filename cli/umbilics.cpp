// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <umbilic/core/errors.h>
#include <umbilic/umbilics/find.h>
#include <umbilic/umbilics/shell_certificate.h>

#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/finite_numbers.h>
#include <cli/lines_and_regions_text.h>
#include <cli/loading.h>
#include <report/json.h>
#include <report/json_geometry.h>
#include <report/output.h>
#include <report/readable.h>
#include <report/umbilics_text.h>

namespace umbilic {

namespace {

/// Faces that have something of their own to tell, one line each; the others are gathered.
std::string face_lines(const Model& model, const std::vector<FaceUmbilics>& all) {
    std::vector<std::pair<std::string, std::string>> lines;
    for (const FaceUmbilics& found : all) {
        const Face& face = model.face(found.face);
        if (!worth_showing(face, found)) continue;
        std::string text;
        const auto add = [&](std::size_t count, const char* noun) {
            if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, noun);
        };
        add(found.umbilics.size(), "umbilic");
        add(found.lines.size(), "line");
        add(found.regions.size(), "region");
        add(found.undecided.size(), "undecided place");
        lines.emplace_back("Face " + std::to_string(face.number), text + "; " + certificate_words(found));
    }
    for (const FaceGroup& group : plain_faces(model, all)) {
        const std::string name = group.faces.size() == 1 ? "Face " + std::to_string(group.faces.front())
                                                         : counted(group.faces.size(), "face");
        lines.emplace_back(name, group.words + (group.faces.size() > 1 ? ": " + number_ranges(group.faces) : ""));
    }
    return facts(lines);
}

std::string shell_lines(const std::vector<ShellCertificate>& shells) {
    std::vector<std::pair<std::string, std::string>> lines;
    for (const ShellGroup& group : shell_groups(shells))
        lines.emplace_back(group.shells == 1 ? "Shell" : counted(group.shells, "shell"),
                           group.words + (shells.size() > 1 ? ": faces " + number_ranges(group.faces) : ""));
    return lines.empty() ? "" : "\n" + facts(lines);
}

std::string umbilic_table(const Model& model, const std::vector<FaceUmbilics>& all) {
    std::vector<std::vector<std::string>> rows;
    bool below_tolerance = false;
    const auto coordinate = [&](double value) { return readable_coordinate(value, model.box.diagonal()); };
    for (const FaceUmbilics& found : all) {
        const Face& face = model.face(found.face);
        for (const Umbilic& umbilic : found.umbilics) {
            const Vector2 native = native_parameters(face, umbilic.at.u, umbilic.at.v);
            const UmbilicClass& kind = umbilic.kind;
            const bool below = umbilic.margin > 0.0 && umbilic.margin < face.tolerance;
            below_tolerance = below_tolerance || below;
            rows.push_back({std::to_string(face.number), readable(native.x(), 8), readable(native.y(), 8),
                            coordinate(umbilic.point.x()), coordinate(umbilic.point.y()), coordinate(umbilic.point.z()),
                            type_words(umbilic), umbilic.flat ? "0" : readable(umbilic.kappa), omega_words(kind),
                            readable(umbilic.index, 2),
                            umbilic.margin > 0.0 ? readable(umbilic.margin, 2) + (below ? " †" : "") : "–",
                            umbilic.certified ? "proved" : "not proved",
                            umbilic.containment == Containment::outside    ? "outside"
                            : umbilic.containment == Containment::boundary ? "on its border"
                                                                           : "inside"});
        }
    }
    if (rows.empty()) return "";
    return "\n" +
           table({"face", "u", "v", "x mm", "y mm", "z mm", "type", "κ 1/mm", "ω", "index", "margin mm", "existence",
                  "face's loops"},
                 rows, {0, 1, 2, 3, 4, 5, 7, 9, 10}) +
           "\nMargin: displacement of the control points up to which the type is sure to stay." +
           (below_tolerance ? " † It is smaller than the tolerance that the file states for the face." : "") + "\n";
}

}  // namespace

void add_umbilics(CLI::App& application, Session& session, Command& command) {
    struct Options {
        std::string path;
        int face = 0;
        UmbilicOptions search;
        std::string report;
    };
    auto* const subcommand =
        application.add_subcommand("umbilics", "Every umbilic of every face, with proofs and certificates");
    const auto options = std::make_shared<Options>();
    subcommand->add_option("FILE", options->path, "STEP, IGES or BREP file")->required();
    subcommand->add_option("--face", options->face, "Only this face, from 1")->check(finite_number(false));
    subcommand
        ->add_option("--tolerance,--umbilic_resolution", options->search.resolution,
                     "Side of the smallest box of the search, relative to the domain")
        ->check(finite_number(false));
    subcommand->add_option("--umbilic_boxes", options->search.boxes_per_patch, "Boxes the search may use on a patch")
        ->check(finite_number(false));
    subcommand
        ->add_option("--umbilic_margin", options->search.generic_margin,
                     "Relative error of the cubic forms that is assumed on top of rounding")
        ->check(finite_number(true));
    subcommand
        ->add_option("--accuracy,--umbilic_accuracy", options->search.accuracy,
                     "How far (mm) control points may be from where they should be: types that this changes are "
                     "called non-generic")
        ->check(finite_number(true));
    subcommand
        ->add_option("--umbilic_recognition", options->search.recognition,
                     "Deviation from a plane or sphere, relative to a face's size, within which it is umbilic "
                     "everywhere; 0 finds the umbilics of its ripples")
        ->check(finite_number(true));
    subcommand->add_option("--report", options->report, "Folder for report.html and umbilics.json")->type_name("DIR");
    add_common_options(*subcommand, session);
    subcommand->callback([&session, &command, options] {
        command = [&session, options] {
            const Progress& progress = session.progress;
            const bool with_report = !options->report.empty();
            if (with_report) check_report_folder(options->report);
            ReadOptions reading;
            reading.display_meshes = with_report;
            const ReadResult read = load(session, options->path, reading, progress.part(0.0, 0.4));
            const Model& model = read.model;
            std::vector<FaceUmbilics> found;
            std::vector<ShellCertificate> shells;
            if (options->face > 0) {
                const auto face = std::find_if(model.faces.begin(), model.faces.end(), [&](const Face& candidate) {
                    return candidate.number == options->face;
                });
                if (face == model.faces.end()) {
                    throw WrongUse(options->path + ": has no face " + std::to_string(options->face) +
                                   "; umbilic info lists its faces");
                }
                found.push_back(find_umbilics(*face, options->search, progress.part(0.4, with_report ? 0.8 : 1.0)));
            } else {
                found = find_umbilics(model, options->search, progress.part(0.4, with_report ? 0.75 : 0.9));
                shells =
                    shell_certificates(model, found, progress.part(with_report ? 0.75 : 0.9, with_report ? 0.8 : 1.0));
            }
            const Json result = umbilics_json(model, found, shells);
            if (with_report) {
                const UmbilicsReportInput input{model,           read.meshes,          found,
                                                options->search, session.command_line, shells};
                write_umbilics_report(options->report, input, result, progress.part(0.8, 1.0));
            }
            clear_progress_bar();
            const UmbilicCounts counts = count_umbilics(model, found);
            std::string text = bold(printable(base_name(options->path)) + ": " + umbilics_headline(counts)) + "\n" +
                               umbilics_explanation(counts) + "\n\n" + face_lines(model, found) + shell_lines(shells) +
                               umbilic_table(model, found) + lines_and_regions_text(model, found);
            if (with_report) {
                text += "\nReport: " + (std::filesystem::path(options->report) / "report.html").string() + "\n";
            }
            print(session, text);
            write_json(session, result);
            return exit_done;
        };
    });
}

}  // namespace umbilic
