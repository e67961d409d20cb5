// An executor for gnomon: threads that wait for work. Adapt it, or give gnomon the pool that your engine has already.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

/// Calls job(i) for every i in [0, count), on its own threads and on the one that asks; one asks at a time. Each thread has a part
/// of them, the same one every time, for what it wrote last frame is in its cache; then it helps the others.
class jthread_pool {
  public:
    /// `threads` in all, of which the one that asks is one; at least one.
    explicit jthread_pool(unsigned threads = std::thread::hardware_concurrency()) : parts_(threads > 1 ? threads : 1) {
        for (std::size_t me = 1; me < parts_.size(); ++me) others_.emplace_back([this, me] { serve(me); });
    }
    ~jthread_pool() {
        stop_ = true;
        ++round_;
        round_.notify_all();
    }
    jthread_pool(const jthread_pool&) = delete;
    jthread_pool& operator=(const jthread_pool&) = delete;

    template <typename Job> void operator()(int count, const Job& job) {
        job_ = &job;
        call_ = [](const void* which, int i) { (*static_cast<const Job*>(which))(i); };
        const int parts = static_cast<int>(parts_.size());
        for (int i = 0; i < parts; ++i) {
            parts_[static_cast<std::size_t>(i)].next = count * i / parts;
            parts_[static_cast<std::size_t>(i)].end = count * (i + 1) / parts;
        }
        busy_ = static_cast<int>(others_.size());
        ++round_; // what was written before is seen by who sees this
        round_.notify_all();
        work(0);
        for (int busy = busy_; busy != 0; busy = busy_) wait_for_another(busy_, busy);
    }

  private:
    struct alignas(64) part {
        std::atomic<int> next = 0;
        int end = 0;
    };

    /// Sleeping and waking takes longer than a frame's filter may: it looks some microseconds first.
    static void wait_for_another(const std::atomic<int>& value, int old) {
        for (int looks = 0; looks < 10'000 && value == old; ++looks) {
        }
        value.wait(old);
    }
    void work(std::size_t me) {
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            part& here = parts_[(me + k) % parts_.size()];
            for (int i = here.next++; i < here.end; i = here.next++) call_(job_, i);
        }
    }
    void serve(std::size_t me) {
        for (int seen = 0;; ++seen) { // the next round waits for all to end this one
            wait_for_another(round_, seen);
            if (stop_) return;
            work(me);
            if (--busy_ == 0) busy_.notify_one();
        }
    }

    std::atomic<int> round_ = 0, busy_ = 0;
    const void* job_ = nullptr;
    void (*call_)(const void*, int) = nullptr;
    bool stop_ = false;
    std::vector<part> parts_;
    std::vector<std::jthread> others_; // the last member: they end before what they use
};
