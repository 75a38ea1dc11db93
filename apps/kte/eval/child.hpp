#pragma once

#include <kte/io/file.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

/// Other programs, run without a shell.
namespace evaluate {

/// How a program ended: its exit code, and whether it said so on its pipe.
struct child_end {
  int code;
  bool confirmed;
  std::string how;  ///< in words
};

/// The status of a child when it has ended. watch(), if there is one, is called every 50 ms; what it throws ends the
/// child and all programs of its group.
inline int status_at_end(pid_t child, const std::function<void()>& watch) {
  int status = 0;
  try {
    for (pid_t ended = 0; ended != child && (ended >= 0 || errno == EINTR);) {
      ended = waitpid(child, &status, watch ? WNOHANG : 0);
      if (ended == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50)), watch();
    }
  } catch (...) {
    kill(-child, SIGKILL), waitpid(child, &status, 0);
    throw;
  }
  return status;
}

/// Runs a program of a path, or where there is no slash of $PATH, with arguments; standard output goes to `output`,
/// standard error to `errors`. If
/// it is to confirm its end, the number of a pipe is its first argument. Given an open file, that is run, whatever the
/// path is by now. With a watch (`status_at_end`) it has its own process group, which Ctrl-C in the terminal does not
/// reach. Throws `kte::bad_file` if it does not start.
inline child_end run_child(const std::string& program, std::vector<std::string> arguments, int output, bool confirm,
                           int open_program = -1, int errors = STDERR_FILENO, const std::function<void()>& watch = {}) {
  constexpr int pipe_of_child = 3, program_of_child = 4, above_these = 10;
  int ends[2] = {-1, -1};
  if (confirm && pipe2(ends, O_CLOEXEC) != 0) kte::detail::raise_file("make a pipe for", program, errno);
  const int read_end = ends[0], write_end = ends[1];
  const int moved = open_program < 0 ? -1 : fcntl(open_program, F_DUPFD_CLOEXEC, above_these);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (output != STDOUT_FILENO) posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  if (errors != STDERR_FILENO) posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  if (confirm) {
    posix_spawn_file_actions_adddup2(&actions, write_end, pipe_of_child);
    arguments.insert(arguments.begin(), std::to_string(pipe_of_child));
  }
  if (moved >= 0) posix_spawn_file_actions_adddup2(&actions, moved, program_of_child);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  if (watch) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const std::string path = moved >= 0 ? "/proc/self/fd/" + std::to_string(program_of_child) : program;
  arguments.insert(arguments.begin(), program);
  std::vector<char*> pointers;
  for (auto& a : arguments) pointers.push_back(a.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawnp(&child, path.c_str(), &actions, &attributes, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions), posix_spawnattr_destroy(&attributes);
  if (confirm) close(write_end);
  if (moved >= 0) close(moved);
  char byte = 0;
  const bool confirmed = confirm && error == 0 && read(read_end, &byte, 1) == 1;
  if (confirm) close(read_end);
  if (error != 0) kte::detail::raise_file("run", program, error);
  const int status = status_at_end(child, watch);
  if (WIFEXITED(status))
    return {WEXITSTATUS(status), confirmed, "with exit code " + std::to_string(WEXITSTATUS(status))};
  return {1, false, "by signal " + std::to_string(WTERMSIG(status))};
}

/// In the child: says that it has done all, whether its exit code is 0 or not.
inline void confirm_end(const char* pipe_of_child) {
  const ssize_t written = write(std::atoi(pipe_of_child), "!", 1);
  static_cast<void>(written);  // if nobody listens, nobody is told
}

}  // namespace evaluate
