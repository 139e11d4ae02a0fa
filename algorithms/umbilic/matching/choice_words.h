// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>

#include <umbilic/matching/choices.h>

namespace umbilic {

/// The words of choices on the command line, in Python and in results.
template <class Choice>
using ChoiceWords = std::map<std::string, Choice>;

inline const ChoiceWords<MethodChoice> method_words = {
    {"auto", MethodChoice::automatic},         {"analytic", MethodChoice::analytic},
    {"umbilics", MethodChoice::umbilics},      {"umbilics-lines", MethodChoice::umbilic_lines},
    {"umbilics-kh", MethodChoice::umbilic_kh}, {"moments", MethodChoice::moments},
    {"curvature", MethodChoice::curvature},    {"kh", MethodChoice::kh},
    {"points", MethodChoice::points}};
inline const ChoiceWords<ScaleSearch> scale_search_words = {{"golden", ScaleSearch::golden_section},
                                                            {"brent", ScaleSearch::brent}};
inline const ChoiceWords<CurvatureSolver> curvature_solver_words = {{"direct", CurvatureSolver::direct},
                                                                    {"auxiliary", CurvatureSolver::auxiliary},
                                                                    {"approximated", CurvatureSolver::approximated}};
inline const ChoiceWords<MirrorChoice> mirror_words = {{"auto", MirrorChoice::automatic},
                                                       {"never", MirrorChoice::never}};
inline const ChoiceWords<ScopeChoice> scope_words = {
    {"auto", ScopeChoice::automatic}, {"global", ScopeChoice::global}, {"partial", ScopeChoice::partial}};

/// The word of a choice; every choice has one.
template <class Choice>
std::string word_of(const ChoiceWords<Choice>& words, Choice choice) {
    for (const auto& [word, value] : words)
        if (value == choice) return word;
    return {};
}

}  // namespace umbilic
