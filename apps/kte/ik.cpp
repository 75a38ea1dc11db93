#include <kte/io/program.hpp>
#include <kte/io/table_number.hpp>
#include <kte/manipulators/nearest.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>

#include "commands.hpp"
#include "json_writer.hpp"
#include "message.hpp"
#include "start.hpp"
#include "state_input.hpp"

namespace kte_tool {

namespace {

struct options {
  reading in;
  std::string frame, poses;
  start_options start;
  bool all = false, numeric = false, json = false;
};

/// Poses over the rows of a table: x, y, z, and qw, qx, qy, qz unless only the place matters.
class pose_table {
 public:
  explicit pose_table(const std::string& path) : table_(path) {
    const auto find = [this](const std::vector<std::string>& names, bool needed) {
      std::vector<std::size_t> found;
      std::string missing;
      for (const auto& n : names) {
        const auto c = table_.names().find(n);
        if (c != table_.names().end())
          found.push_back(c->second);
        else
          missing += (missing.empty() ? " " : ", ") + n;
      }
      if (!missing.empty() && (needed || !found.empty()))
        throw kte::bad_file("kte: " + table_.path().string() + ":1: missing columns:" + missing);
      return found;
    };
    position_ = find({"x", "y", "z"}, true), rotation_ = find({"qw", "qx", "qy", "qz"}, false);
  }
  std::size_t rows() const { return table_.rows(); }
  bool has_rotation() const { return !rotation_.empty(); }
  kte::vec3<> position(std::size_t row) const {
    return {table_.at(row, position_[0]), table_.at(row, position_[1]), table_.at(row, position_[2])};
  }
  /// The rotation of a quaternion of any length but 0.
  kte::mat3<kte::vec3<>> rotation(std::size_t row) const {
    double q[4], size = 0;
    for (std::size_t i = 0; i < 4; ++i) q[i] = table_.at(row, rotation_[i]), size = std::max(size, std::abs(q[i]));
    if (size == 0) throw kte::bad_file("kte: " + table_.place(row) + "the quaternion has length 0");
    return kte::matrix_of_any_length(  // of numbers up to 1, so that no square overflows or vanishes
        kte::unit_quaternion<>{q[0] / size, q[1] / size, q[2] / size, q[3] / size});
  }
  std::string place(std::size_t row) const { return table_.place(row); }

 private:
  evaluate::state_table table_;
  std::vector<std::size_t> position_, rotation_;
};

/// A posture for a pose.
struct answer {
  std::size_t pose;
  std::string status;
  Eigen::VectorXd q;
  double position, rotation;  ///< by which it misses, m and rad
};

const char* status_text(kte::numerical_ik_status s) {
  switch (s) {
    case kte::numerical_ik_status::reached:
      return "reached";
    case kte::numerical_ik_status::at_limits:
      return "at_limits";
    case kte::numerical_ik_status::local_minimum:
      return "local_minimum";
  }
  return "";
}

class solver {
  using arm_type = kte::manipulator<kte::runtime_chain>;

 public:
  solver(const options& o, const mechanism& m) : arm_(m.chain(), o.frame, m.robot.limits), o_(o) {
    has_formulas_ = arm_.family() != kte::arm_family::none && !o.numeric;
  }
  bool has_formulas() const { return has_formulas_; }

  /// All postures, by formulas.
  void add_all(std::size_t row, const pose_table& poses, std::vector<answer>& out) const {
    for (const auto& a : kte::inverse_kinematics(arm_, kte::pose{poses.rotation(row), poses.position(row)}))
      out.push_back({row,
                     !a.exact          ? "missed"
                     : a.within_limits ? "reached"
                                       : "beyond_limits",
                     Eigen::VectorXd(a.q), a.position, a.rotation});
  }
  /// The nearest to q, which is then that.
  void add_nearest(std::size_t row, const pose_table& poses, Eigen::VectorXd& q, std::vector<answer>& out) const {
    if (has_formulas_ && poses.has_rotation()) {
      try {
        const auto a =
            kte::inverse_kinematics(arm_, kte::pose{poses.rotation(row), poses.position(row)}, kte::nearest(q));
        q = Eigen::VectorXd(a.q);
        out.push_back({row, "reached", q, a.position, a.rotation});
        return;
      } catch (const kte::unreachable&) {  // then the nearest that there is within limits
      }
    }
    const kte::numerical_ik_options how{.numeric = o_.numeric};
    const auto put = [&](const auto& r) {
      q = Eigen::VectorXd(r.q);
      out.push_back({row, status_text(r.status), q, r.position, r.rotation});
    };
    if (poses.has_rotation())
      put(kte::numerical_inverse_kinematics(
          arm_, kte::reach(o_.frame, kte::pose{poses.rotation(row), poses.position(row)}), q, how));
    else
      put(kte::numerical_inverse_kinematics(arm_, kte::reach_position(o_.frame, poses.position(row)), q, how));
  }

 private:
  arm_type arm_;
  const options& o_;
  bool has_formulas_;
};

std::string text_of(const std::vector<answer>& all, const evaluate::column_order& order) {
  std::string s = "pose,status";
  for (std::size_t i = 0; i < order.q.size(); ++i) s += ",q_" + std::to_string(i);
  s += ",position_error,rotation_error\n";
  for (const auto& a : all) {
    s += std::to_string(a.pose) + ',' + a.status;
    const auto put = [&s](double x) {
      s += ',';
      kte::detail::append_table_number(s, x);
    };
    for (const int i : order.q) put(a.q[i]);
    put(a.position), put(a.rotation);
    s += '\n';
  }
  return s;
}

std::string json_of(const std::vector<answer>& all, const mechanism& m, const evaluate::column_order& order) {
  json_writer j;
  j.object().member("file", m.file).key("answers").list();
  for (const auto& a : all) {
    std::vector<double> q;
    for (const int i : order.q) q.push_back(a.q[i]);
    j.object().member("pose", a.pose).member("status", a.status).member("q", q);
    j.member("position_error", a.position).member("rotation_error", a.rotation).end();
  }
  return j.end().end().text();
}

int ik(const options& o) {
  if (o.frame.empty()) throw usage_error("--frame is required: the frame that the poses are of");
  if (o.poses.empty()) throw usage_error("--poses is required: a table with columns x, y, z and qw, qx, qy, qz");
  const auto m = read_and_warn(o.in);
  const pose_table poses(o.poses);
  const solver s(o, m);
  if (o.all && (!s.has_formulas() || !poses.has_rotation()))
    throw kte::bad_argument("kte: --all needs an arm with closed-form solutions and poses with a rotation");
  Eigen::VectorXd q = initial_state(o.start, m, m.chain()).q;
  std::vector<answer> all;
  std::size_t missed = 0;
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    try {
      const auto before = all.size();
      o.all ? s.add_all(row, poses, all) : s.add_nearest(row, poses, q, all);
      missed += std::none_of(all.begin() + static_cast<std::ptrdiff_t>(before), all.end(),
                             [](const answer& a) { return a.status == "reached"; });
    } catch (const kte::bad_file&) {
      throw;
    } catch (const kte::error& e) {
      throw kte::bad_file("kte: " + poses.place(row) + std::string(e.what()).substr(5));
    }
  }
  const evaluate::column_order order(kte::layout(m.chain()), coordinates_of(m, m.chain()));
  kte::detail::write_standard_output(o.json ? json_of(all, m, order) : text_of(all, order));
  if (missed > 0) say(std::to_string(missed) + " of " + std::to_string(poses.rows()) + " poses are not reached");
  return missed > 0 ? 1 : 0;
}

}  // namespace

void add_ik(command_line& line) {
  const auto o = std::make_shared<options>();
  auto& c = add_reading(
                line.add("ik", "finds joint configurations for poses of a frame",
                         "Inverse kinematics: prints a configuration within limits for each pose of a table, in closed "
                         "form if the arm has one, else numerically. Each is the nearest to the previous one. The exit "
                         "code is 1 if a pose is not reached; the table then has the nearest configuration found."),
                o->in)
                .text("--frame", "NAME", o->frame, "the frame of the poses, such as the tool")
                .text("--poses", "TABLE", o->poses,
                      "columns x, y, z, m, and qw, qx, qy, qz, a quaternion, in world axes; without the latter only "
                      "the position matters");
  add_start(c, o->start)
      .flag("--all", o->all, "prints all closed-form configurations of a pose, including those beyond limits")
      .flag("--numeric", o->numeric, "always solves numerically")
      .flag("--json", o->json, "prints JSON")
      .runs([o] { return ik(*o); });
}

}  // namespace kte_tool
