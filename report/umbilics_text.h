// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/model/model.h>
#include <umbilic/umbilics/shell_certificate.h>
#include <umbilic/umbilics/umbilic.h>

namespace umbilic {

/// What was found on all faces, counted. Isolated umbilics outside of the trimming loops count for themselves.
struct UmbilicCounts {
    std::size_t isolated = 0, outside = 0;
    std::size_t stars = 0, monstars = 0, lemons = 0, non_generic = 0;  ///< of the isolated ones
    std::size_t lines = 0, regions = 0, undecided = 0;                 ///< on faces that are no planes or spheres
    std::size_t faces = 0, complete = 0, incomplete = 0;
    std::size_t whole = 0;  ///< planes and spheres: every point is an umbilic, and nothing is left to prove
};

UmbilicCounts count_umbilics(const Model& model, const std::vector<FaceUmbilics>& all);

/// The first line for people, e.g. "5 isolated umbilics: 4 stars and 1 monstar".
std::string umbilics_headline(const UmbilicCounts& counts);
/// What is known about completeness and what else there is, in sentences.
std::string umbilics_explanation(const UmbilicCounts& counts);

/// The certificate in plain words, e.g. "complete: every umbilic of this face is listed; proved".
std::string certificate_words(const FaceUmbilics& found);

/// A type with its kind of star; a non-generic one with the types it may have: "non-generic: monstar or lemon".
std::string class_words(const UmbilicClass& kind);
/// The same with "at a pole" and "flat" where that holds.
std::string type_words(const Umbilic& umbilic);
/// omega as "a + bi", "∞" where alpha = 0.
std::string omega_words(const UmbilicClass& kind);

/// True if the face has something of its own to show: umbilics, lines, undecided places, or regions that do not follow
/// from the kind of its surface.
bool worth_showing(const Face& face, const FaceUmbilics& found);

/// Faces that need no picture, gathered under what is to be said of them.
struct FaceGroup {
    std::string words;
    std::vector<int> faces;
};
std::vector<FaceGroup> plain_faces(const Model& model, const std::vector<FaceUmbilics>& all);

/// A shell's certificate in plain words, e.g. "closed, genus 0; complete: the indices sum to Euler's characteristic 2".
std::string shell_words(const ShellCertificate& shell);

/// Shells gathered under what is to be said of them; `faces` are those of all of them.
struct ShellGroup {
    std::string words;
    std::size_t shells = 0;
    std::vector<int> faces;
};
std::vector<ShellGroup> shell_groups(const std::vector<ShellCertificate>& shells);

/// Numbers in increasing order with runs joined: "1–4, 7".
std::string number_ranges(const std::vector<int>& numbers);

/// "1 line", "2 lines".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace umbilic
