// An executor for gnomon: threads that wait for work. Adapt it, or give gnomon the pool that your engine has already.
#pragma once

#include <atomic>
#include <barrier>
#include <thread>
#include <vector>

/// Calls job(i) for every i in [0, count), on its own threads and on the one that asks; one asks at a time.
class jthread_pool {
  public:
    /// `threads` in all, of which the one that asks is one; at least one.
    explicit jthread_pool(unsigned threads = std::thread::hardware_concurrency())
        : begin_(threads > 1 ? threads : 1), end_(threads > 1 ? threads : 1) {
        for (unsigned i = 1; i < threads; ++i) others_.emplace_back([this] { serve(); });
    }
    ~jthread_pool() {
        stop_ = true;
        begin_.arrive_and_wait();
    }
    jthread_pool(const jthread_pool&) = delete;
    jthread_pool& operator=(const jthread_pool&) = delete;

    template <typename Job> void operator()(int count, const Job& job) {
        job_ = &job;
        call_ = [](const void* which, int i) { (*static_cast<const Job*>(which))(i); };
        count_ = count;
        next_ = 0;
        begin_.arrive_and_wait();
        work();
        end_.arrive_and_wait();
    }

  private:
    void work() {
        for (int i = next_++; i < count_; i = next_++) call_(job_, i);
    }
    void serve() {
        for (begin_.arrive_and_wait(); !stop_; begin_.arrive_and_wait()) {
            work();
            end_.arrive_and_wait();
        }
    }

    std::barrier<> begin_, end_;
    std::atomic<int> next_ = 0;
    const void* job_ = nullptr;
    void (*call_)(const void*, int) = nullptr;
    int count_ = 0;
    bool stop_ = false;
    std::vector<std::jthread> others_; // the last member: they end before what they use
};
