// SPDX-License-Identifier: LGPL-2.1-or-later
#include "catalogue.h"

#include <numbers>

#include "blade.h"
#include "bottle.h"
#include "bottle_suspects.h"
#include "regions.h"
#include "reliefs.h"
#include "solids.h"

namespace umbilic::models {
namespace {

using std::numbers::pi;

void add_bottles(Catalogue& catalogue) {
    const Bottle original = bottle();
    const std::string file = "bottle.step";
    catalogue.models.push_back({file, "bottle",
                                "Shampoo bottle: front and back bicubic with 8x8 poles, ruled neck, "
                                "open at the bottom and the mouth; no symmetry",
                                shell_of(original)});
    catalogue.pairs.push_back({file, file, true, {}, "same", "strong", "the file against itself"});

    // The suspect stored is the given shape moved by the inverse of its pose on the original.
    const auto add_suspect = [&](const std::string& name, const std::string& description, const TopoDS_Shape& shape,
                                 const Similarity& move, Pair pair) {
        catalogue.models.push_back({name, "part", description, transformed(shape, move)});
        pair.original = file;
        pair.suspect = name;
        pair.original_suspect = inverse(move);
        catalogue.pairs.push_back(pair);
    };

    add_suspect("bottle_suspect.igs",
                "The bottle moved, scaled by 0.37 and reparametrised exactly: degrees 4 and 5, more knots, "
                "u and v swapped, other parameter ranges",
                reparametrised_bottle(original), pose(0.37, {0.3, -0.8, 0.5}, 2.2, {61, -140, 37}),
                {.answer = "scaled", .level = "strong"});

    const Reapproximation reapproximation = reapproximated_bottle(original);
    add_suspect("bottle_reapproximated.step",
                "The bottle interpolated by quintics with 21x21 poles and other knots, moved and scaled by 1.6",
                reapproximation.shape, pose(1.6, {-0.6, 0.2, 0.7}, 1.1, {-220, 45, 310}),
                {.answer = "reapproximated",
                 .level = "strong",
                 .facts = {{"largest_distance", reapproximation.largest_distance}}});

    add_suspect("bottle_mirrored.step", "The mirror image of the bottle, moved", shell_of(original),
                pose(1, {0.5, 0.4, -0.9}, 0.9, {130, 72, -55}, true), {.answer = "mirrored", .level = "strong"});

    const Piece piece = bottle_piece(original);
    const Similarity piece_move = pose(1, {0.9, 0.3, 0.2}, 1.7, {-75, 160, 20});
    const nlohmann::ordered_json shares = {{"share_of_front", piece.share_of_front},
                                           {"share_of_bottle", piece.share_of_bottle}};
    add_suspect("bottle_cut.step", "A cut-out of the bottle's front, trimmed by a closed curve, moved", piece.shape,
                piece_move, {.answer = "piece", .level = "strong", .facts = shares});
    catalogue.pairs.push_back({.original = "bottle_cut.step",
                               .suspect = file,
                               .original_suspect = piece_move,
                               .answer = "contains",
                               .level = "strong",
                               .note = "the piece taken as the original",
                               .facts = shares});

    const Redesign redesign = redesigned_bottle(original);
    add_suspect(
        "bottle_redesigned.igs", "The bottle with one region of the front bulged, the rest identical; moved",
        redesign.shape, pose(1, {-0.2, 0.7, 0.6}, 2.6, {48, -33, 190}),
        {.answer = "partly",
         .level = "none",
         .note = "as a whole it fails the weak test by the bulge; outside the bulge it is the same point set",
         .facts = {{"changed_share_of_bottle", redesign.changed_share}, {"largest_change", redesign.largest_change}}});

    catalogue.models.push_back(
        {"bottle_other.step", "bottle", "An unrelated bottle: slimmer, taller, pear-shaped", shell_of(other_bottle())});
    catalogue.pairs.push_back({.original = file,
                               .suspect = "bottle_other.step",
                               .related = false,
                               .answer = "different",
                               .level = "none",
                               .note = "two designs of the same kind"});
}

void add_free_form(Catalogue& catalogue) {
    catalogue.models.push_back({"hood.step",
                                "hood",
                                "Car hood, one bicubic face with 8x8 poles, mirror-symmetric in x = 0",
                                hood(),
                                {{"mirror_symmetric", true}}});
    catalogue.models.push_back({"mask.igs", "mask", "Mask-like relief, one bicubic face with 26x26 poles", mask()});
    catalogue.models.push_back({"monge_umbilics.step", "patch",
                                "Wave-like bicubic Bezier patch over the unit square with five known umbilics "
                                "(Patrikalakis, Maekawa and Cho, section 9.6)",
                                monge_umbilics()});
    catalogue.models.push_back(
        {"blade.step", "blade", "Twisted fan blade, two bicubic faces with 6x7 poles, no umbilic", blade()});
    const Similarity move = pose(1, {0.2, 0.9, -0.4}, 2.9, {-140, 80, 33});
    catalogue.models.push_back({"blade_moved.igs", "part", "The blade moved", transformed(blade(), move)});
    catalogue.pairs.push_back({"blade.step", "blade_moved.igs", true, inverse(move), "moved", "intermediate",
                               "no umbilic, so the strong test does not apply"});
    catalogue.pairs.push_back(
        {.original = "hood.step", .suspect = "mask.igs", .related = false, .answer = "different", .level = "none"});
}

void add_analytic(Catalogue& catalogue) {
    catalogue.models.push_back(
        {"bracket.step", "bracket", "Solid of planes, cylinders, a cone and a torus fillet; no symmetry", bracket()});
    const Similarity move = pose(25.4, {-0.7, 0.1, 0.6}, 1.3, {900, -2100, 400});
    catalogue.models.push_back({"bracket_moved.igs", "part",
                                "The bracket moved and scaled by 25.4, as if inches had been taken for millimetres",
                                transformed(bracket(), move)});
    catalogue.pairs.push_back({"bracket.step", "bracket_moved.igs", true, inverse(move), "scaled", "intermediate",
                               "a unit mix-up; no isolated umbilic, so the strong test does not apply"});
    catalogue.models.push_back({"sphere.igs",
                                "ball",
                                "Ball of radius 25 mm",
                                ball(),
                                {{"area", 4 * pi * 625}, {"volume", 4 * pi * 15625 / 3}}});
    catalogue.models.push_back({"torus.step",
                                "ring",
                                "Ring, radii 40 and 12 mm",
                                ring(),
                                {{"area", 4 * pi * pi * 40 * 12}, {"volume", 2 * pi * pi * 40 * 144}}});
    // Closed form: x^2 = a^2 (a^2 - b^2) / (a^2 - c^2), z^2 = c^2 (b^2 - c^2) / (a^2 - c^2), kappa = a c / b^3.
    catalogue.models.push_back(
        {"ellipsoid.step",
         "ellipsoid",
         "Ellipsoid with semi-axes 30, 20, 10 mm as one exact rational B-spline with a seam and two poles; "
         "four lemons in y = 0, all with alpha = 0",
         ellipsoid(),
         {{"volume", 4 * pi / 3 * 6000},
          {"umbilic_abs_x", 30 * std::sqrt(500.0 / 800)},
          {"umbilic_abs_z", 10 * std::sqrt(300.0 / 800)},
          {"umbilic_kappa", 300.0 / 8000}}});
}

void add_regions(Catalogue& catalogue) {
    const DomePlate measures;
    catalogue.models.push_back({"dome_plate.step",
                                "dome plate",
                                "Plate with a spherical dome and a rounding between them, all exact B-splines: "
                                "a planar and a spherical region",
                                dome_plate(measures),
                                {{"spherical_area", measures.dome_area()},
                                 {"fillet_area", measures.fillet_area()},
                                 {"planar_area", measures.plate_area()}}});
    const double width = 90.0 * 4 / 7, height = 70.0 * 3 / 5;
    catalogue.models.push_back({"planar_block.step",
                                "sheet",
                                "One bicubic face with 10x8 poles, exactly flat in u <= 4/7, v <= 3/5",
                                planar_block(),
                                {{"planar_area", width * height}}});
}

}  // namespace

Catalogue build_catalogue() {
    Catalogue catalogue;
    add_bottles(catalogue);
    add_free_form(catalogue);
    add_analytic(catalogue);
    add_regions(catalogue);
    return catalogue;
}

}  // namespace umbilic::models
