// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/matching/prepared_points.h>
#include <umbilic/similarity/assessment.h>

namespace umbilic {

/// Highest test passed, in the order of the thesis's hierarchy (5.2).
enum class Level { none, weak, intermediate, strong };

/// One step of a decision algorithm: the question asked, with its numbers, and the answer.
struct DecisionStep {
    std::string question;
    bool answer = false;
};

struct Decision {
    Level level = Level::none;
    std::vector<DecisionStep> path;
};

/// Decision algorithm 1 (thesis 5.2.1, Fig. 5-1): maxima against tolerances.
Decision decide_by_maxima(const Assessment& assessment);
/// Decision algorithm 2 (thesis 5.2.2, Fig. 5-2): statistics against thresholds.
Decision decide_by_statistics(const Assessment& assessment);

struct Verdict {
    Decision algorithm_1;
    Decision algorithm_2;
    int chosen_algorithm = 2;
    Level level = Level::none;  ///< of the chosen algorithm
    bool derived = false;       ///< level is not none
    std::string explanation;    ///< one sentence a lawyer can read
};

Verdict decide(const Alignment& alignment, const Assessment& assessment, int algorithm = 2);

/// The first thing a person reads.
enum class AnswerClass { same, moved, scaled, mirrored, piece, contains, reapproximated, partly, different };

struct Answer {
    AnswerClass kind = AnswerClass::different;
    std::string text;  ///< plain words, e.g. "the same shape, moved, scaled by 2.540 (unit mix-up?)"
};

Answer answer(const Model& original, const Model& suspect, const Alignment& alignment, const Assessment& assessment,
              const Verdict& verdict);

/// The same of measured points: a scan of the whole original or of a piece of it, within which distance its points lie
/// on it, and how much of it they cover. `suspect` is a mesh or a cloud.
Answer answer(const PreparedPoints& suspect, const Alignment& alignment, const Assessment& assessment);

const char* name(Level level);
const char* name(AnswerClass kind);

}  // namespace umbilic
