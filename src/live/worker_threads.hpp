#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace kte::live {

/// Threads that answer requests, and a queue in front of them that is never long.
class worker_threads {
 public:
  worker_threads() {
    for (int i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
  }
  /// Waits while the queue is full.
  void enqueue(std::function<void()> task) {
    std::unique_lock<std::mutex> l(mutex_);
    taken_.wait(l, [this] { return tasks_.size() < longest; });
    tasks_.push_back(std::move(task));
    news_.notify_one();
  }
  /// After the last task.
  ~worker_threads() {
    {
      const std::unique_lock<std::mutex> l(mutex_);
      ended_ = true;
      news_.notify_all();
    }
    for (auto& t : threads_) t.join();
  }

 private:
  static constexpr int count = 16;  // more than pages
  static constexpr std::size_t longest = 16;

  void work() {
    for (;;) {
      std::function<void()> task;
      {
        std::unique_lock<std::mutex> l(mutex_);
        news_.wait(l, [this] { return ended_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        task = std::move(tasks_.front());
        tasks_.pop_front();
        taken_.notify_one();
      }
      task();
    }
  }

  std::mutex mutex_;
  std::condition_variable news_, taken_;
  std::deque<std::function<void()>> tasks_;
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace kte::live
