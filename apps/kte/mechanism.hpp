#pragma once

#include <kte/io/model_reader.hpp>
#include <kte/robots/options.hpp>
#include <kte/robots/robot.hpp>

#include <filesystem>

#include "command_line.hpp"

namespace kte_tool {

/// How a file is read.
struct reading {
  std::string file;
  kte::robot_options robot;
  bool joint_dynamics = false, no_joint_dynamics = false;  ///< as the command line says
};
/// The file and how it is read, as arguments; whether joints have damping, friction, springs and rotors if nothing
/// says.
command& add_reading(command& c, reading& o, bool joint_dynamics = true);

/// --ground, --friction, --restitution, --contact-stiffness and --contact-dissipation.
command& add_contacts(command& c, reading& o);
/// Throws `usage_error` for these options without those that they need.
void check_contacts(const reading& o);

kte::robot_options robot_options_of(const reading& o);

/// What a file holds, whatever its format.
struct mechanism {
  std::string file, format;                           ///< "URDF", "MJCF", "SDF", "model file"
  kte::robot robot;                                   ///< of a model file its chain and limits
  std::optional<kte::robot_description> description;  ///< of files of robots
  std::optional<kte::model_record> model;             ///< of model files

  bool stands = false;  ///< on a ground, in the configuration "standing"

  const kte::runtime_chain& chain() const { return robot.chain; }
};
/// The file can be read, but links and joints make no chain: `what()` says why.
struct broken_mechanism : kte::bad_file {
  broken_mechanism(const std::string& why, std::string of_format, kte::robot_description d)
      : bad_file(why), format(std::move(of_format)), description(std::move(d)) {}
  std::string format;
  kte::robot_description description;
};
/// Throws what the readers throw, and `broken_mechanism`.
mechanism read_mechanism(const reading& o);
/// Writes warnings about it to standard error. `with_motors`: omits warnings about motors, which are added later.
mechanism read_and_warn(const reading& o, bool with_motors = false);

/// The free coordinates of a chain in the order of the robot's file; of a model file in that of its chain.
std::vector<std::string> coordinates_of(const mechanism& m, const kte::runtime_chain& chain);

/// The note of a message of the library that begins with its place in the file.
kte::robot_note placed(kte::robot_note note, const std::string& file);
/// "arm.urdf:37: what is odd", of each note once.
std::vector<std::string> texts_of(const std::vector<kte::robot_note>& notes, const std::string& source);

}  // namespace kte_tool
