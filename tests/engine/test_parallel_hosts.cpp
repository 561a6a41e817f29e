// Inside a host's own parallel regions: nobody waits for ever, and no more threads are at work than the host
// has allowed. Every executor under both kinds of host.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <tuple>

#include "engine/parallel.hpp"
#include "executors.hpp"
#include "rooms.hpp"
#include "same_answer.hpp"

extern "C" void omp_set_max_active_levels(int levels);

namespace landfall {
namespace {

constexpr int host_threads = 2;

// How many threads are inside of it at a time.
class Crowd {
 public:
  void visit() {
    const int now = ++inside_;
    for (int seen = most_; now > seen && !most_.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    --inside_;
    ++visits_;
  }
  [[nodiscard]] int most() const { return most_; }
  [[nodiscard]] int visits() const { return visits_; }

 private:
  std::atomic<int> inside_{0};
  std::atomic<int> most_{0};
  std::atomic<int> visits_{0};
};

using Task = std::function<void(int)>;

void run_in_openmp(int tasks, const Task& task) {
#pragma omp parallel for num_threads(host_threads) schedule(static, 1)
  for (int i = 0; i < tasks; ++i) task(i);
}

void run_in_tbb(int tasks, const Task& task) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, host_threads);
  tbb::parallel_for(0, tasks, task);
}

class InsideAHost : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  static void run(int tasks, const Task& task) {
    (std::get<0>(GetParam()) == "openmp" ? run_in_openmp : run_in_tbb)(tasks, task);
  }

 private:
  const testing::UsedExecutor used_{std::get<1>(GetParam())};
};

INSTANTIATE_TEST_SUITE_P(Hosts, InsideAHost,
                         ::testing::Combine(::testing::Values("openmp", "tbb"),
                                            ::testing::ValuesIn(testing::executor_names())),
                         [](const auto& of) {
                           return std::get<1>(of.param) + "_in_" + std::get<0>(of.param);
                         });

TEST_P(InsideAHost, NoMoreThreadsWorkThanItAllowed) {
  for (const int threads : {0, 2, 5}) {
    Crowd crowd;
    run(4, [&](int) { internal::parallel_for(50, threads, [&](std::size_t) { crowd.visit(); }); });
    EXPECT_EQ(crowd.visits(), 200);
    EXPECT_LE(crowd.most(), host_threads) << threads << " threads";
  }
}

// A region in a region in the host's.
TEST_P(InsideAHost, NestedRegionsAddNone) {
  Crowd crowd;
  run(4, [&](int) {
    internal::parallel_for(
        5, 0, [&](std::size_t) { internal::parallel_for(10, 0, [&](std::size_t) { crowd.visit(); }); });
  });
  EXPECT_EQ(crowd.visits(), 200);
  EXPECT_LE(crowd.most(), host_threads);
}

TEST_P(InsideAHost, ExceptionsReachTheCallerInItsThread) {
  std::atomic<int> caught{0};
  run(4, [&](int) {
    try {
      internal::parallel_for(50, 0, [](std::size_t i) {
        if (i == 20) throw std::runtime_error("twenty");
      });
    } catch (const std::runtime_error&) {
      ++caught;
    }
  });
  EXPECT_EQ(caught, 4);
}

// All tasks need everything of a map of which nothing is built yet.
TEST_P(InsideAHost, SearchesShareAFreshMap) {
  const Scan scan =
      testing::look(PreparedMap(testing::furnished_room()), testing::full_circle(90), {2.31, 3.17, 0.4});
  SearchOptions options{.rotation_step_rad = 0.1};
  const SearchResult expected = search(PreparedMap(testing::furnished_room()), {Anywhere{}}, scan, options);
  ASSERT_EQ(expected.verdict, Verdict::found);
  for (const int threads : {0, 1, 2}) {
    options.threads = threads;
    const PreparedMap fresh(testing::furnished_room());
    std::vector<std::vector<SearchResult>> results(8);
    run(8, [&](int i) {
      const std::vector<Scan> scans(static_cast<std::size_t>(1 + i % 3), scan);
      results[static_cast<std::size_t>(i)] = search(fresh, {Anywhere{}}, scans, options);
    });
    for (const std::vector<SearchResult>& batch : results) {
      ASSERT_FALSE(batch.empty());
      for (const SearchResult& result : batch) testing::expect_same_answer(result, expected);
    }
  }
}

// A host that lets its regions nest gets what it asks for.
TEST(OpenMpHost, MayLetRegionsNest) {
  const testing::UsedExecutor used("openmp");
  std::atomic<int> least_count{1000};
  const auto ask = [&](int) {
    const int count = internal::thread_count(2);
    for (int seen = least_count; count < seen && !least_count.compare_exchange_weak(seen, count);) {
    }
  };
  omp_set_max_active_levels(2);
  const int outside = internal::thread_count(2);
  run_in_openmp(4, ask);
  omp_set_max_active_levels(1);
  EXPECT_EQ(least_count, outside);
  run_in_openmp(4, ask);
  EXPECT_EQ(least_count, 1);
}

}  // namespace
}  // namespace landfall
