#pragma once

#include <kte/manipulators/detail/arm_geometry.hpp>

#include <string>
#include <vector>

#include "timing.hpp"

/// Inverse kinematics: which arms are asked, and how answers are judged.
namespace bench {

/// An arm as numbers: m, rad.
struct arm_numbers {
  kte::detail::arm_geometry geometry;
  double reach;
  std::vector<double> lower, upper;  ///< limits of the joints
};
/// "3R3R", "ur5" or "iiwa14": those of kte/manipulators.
const arm_numbers& arm_of(const std::string& model);

/// One question to an arm: the pose of a posture, the rotation by rows, where to start, if that is requested, and of
/// seven axes the arm angle of the posture.
struct arm_question {
  double rotation[9], position[3];
  const double* start;  ///< within limits
  double arm_angle;
};
/// Answers `together` questions, out of line: joint angles, answer after answer, at most 16, to q, of each question
/// `room_for_answers` behind those of the last; how many there are to `count`.
using answer_call = void (*)(const arm_question* x, double* q, int* count);
inline constexpr std::size_t room_for_answers = 16 * kte::detail::arm_geometry::most;

/// Whether a method must find the posture from which the pose was computed, or any posture.
enum class answer_kind { posture, any };

/// Registers `inverse_kinematics/how/model`: time of a question, each time another of 512. Postures and starts are
/// random within limits. Counters: `error`, the largest of all answers, of the position relative to the reach or of the
/// rotation in rad, by kinematics in extended precision; `found`, the share of questions that have what is needed among
/// the answers; `answers`, how many there are to a question.
void add_arm(const std::string& how, const std::string& model, answer_kind what, answer_call f,
             std::size_t together = 1);

}  // namespace bench
