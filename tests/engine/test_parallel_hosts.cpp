// Inside a host's own parallel regions: nobody waits for ever, and no more threads are at work than the host
// has allowed. Every executor under both kinds of host.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <tuple>

#include "engine/base/parallel.hpp"
#include "executors.hpp"
#include "rooms.hpp"
#include "same_answer.hpp"

extern "C" {
int omp_get_max_active_levels();
void omp_set_max_active_levels(int levels);
void omp_set_num_threads(int threads);
}

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

// How deep a host lets OpenMP's regions nest, until it goes out of scope.
class ActiveLevels {
 public:
  explicit ActiveLevels(int levels) { omp_set_max_active_levels(levels); }
  ~ActiveLevels() { omp_set_max_active_levels(before_); }
  ActiveLevels(const ActiveLevels&) = delete;
  ActiveLevels& operator=(const ActiveLevels&) = delete;

 private:
  const int before_ = omp_get_max_active_levels();
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
  const ActiveLevels flat_{1};
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

// The least that one of a host's tasks gets which asks for so many threads.
int least_thread_count(int threads) {
  std::atomic<int> least{1000};
  run_in_openmp(4, [&](int) {
    const int count = internal::thread_count(threads);
    for (int seen = least; count < seen && !least.compare_exchange_weak(seen, count);) {
    }
  });
  return least;
}

// A host that lets its regions nest gets what it asks for.
TEST(OpenMpHost, MayLetRegionsNest) {
  const testing::UsedExecutor used("openmp");
  const int outside = internal::thread_count(2);
  {
    const ActiveLevels nested(2);
    EXPECT_EQ(least_thread_count(2), outside);
  }
  const ActiveLevels flat(1);
  EXPECT_EQ(least_thread_count(2), 1);
}

TEST(OpenMpHost, OffersANestedRegionWhatItSaysThere) {
  const testing::UsedExecutor used("openmp");
  const ActiveLevels nested(2);
  for (const int offered : {1, 3}) {
    std::atomic<int> most{0}, sum{0};
    run_in_openmp(host_threads, [&](int) {
      omp_set_num_threads(offered);  // of this region alone
      sum += internal::thread_count(8) + internal::thread_count(0);
      Crowd crowd;
      internal::parallel_for(20, 8, [&](std::size_t) { crowd.visit(); });
      for (int seen = most; crowd.most() > seen && !most.compare_exchange_weak(seen, crowd.most());) {
      }
    });
    EXPECT_EQ(sum, 2 * offered * host_threads);
    EXPECT_LE(most, offered);
  }
}

// Its threads are busy, though regions of its own might nest.
TEST(OpenMpHost, GetsNoThreadsOfOneTbbBesideItsOwn) {
  const testing::UsedExecutor used("tbb");
  const ActiveLevels nested(2);
  EXPECT_EQ(least_thread_count(0), 1);
  EXPECT_EQ(least_thread_count(8), 1);
  Crowd crowd;
  run_in_openmp(4, [&](int) { internal::parallel_for(50, 8, [&](std::size_t) { crowd.visit(); }); });
  EXPECT_EQ(crowd.visits(), 200);
  EXPECT_LE(crowd.most(), host_threads);
}

// An arena of a host's own, where the machine has more threads.
class InsideAnArena : public ::testing::TestWithParam<std::string> {
 protected:
  static constexpr int arena_threads = 3;

  void run(const std::function<void()>& work) { arena_.execute(work); }

 private:
  const testing::UsedExecutor used_{GetParam()};
  const tbb::global_control machine_{tbb::global_control::max_allowed_parallelism, 8};
  tbb::task_arena arena_{arena_threads};
};

INSTANTIATE_TEST_SUITE_P(Executors, InsideAnArena, ::testing::ValuesIn(testing::executor_names()),
                         [](const auto& of) { return of.param; });

TEST_P(InsideAnArena, OneCallUsesNoMoreThreadsThanItHas) {
  for (const int threads : {0, 2, 8}) {
    Crowd crowd;
    run([&] { internal::parallel_for(100, threads, [&](std::size_t) { crowd.visit(); }); });
    EXPECT_EQ(crowd.visits(), 100);
    EXPECT_LE(crowd.most(), threads == 2 ? 2 : arena_threads) << threads << " threads";
  }
}

TEST_P(InsideAnArena, ItsTasksUseNoMoreThreadsThanItHas) {
  for (const int threads : {0, 2, 8}) {
    Crowd crowd;
    run([&] {
      tbb::parallel_for(
          0, 6, [&](int) { internal::parallel_for(30, threads, [&](std::size_t) { crowd.visit(); }); });
    });
    EXPECT_EQ(crowd.visits(), 180);
    EXPECT_LE(crowd.most(), arena_threads) << threads << " threads";
  }
}

TEST_P(InsideAnArena, ExceptionsReachTheCaller) {
  std::atomic<int> begun{0};
  const auto fail = [&] {
    internal::parallel_for(1000, 2, [&](std::size_t) {
      ++begun;
      throw std::runtime_error("any");
    });
  };
  EXPECT_THROW(run(fail), std::runtime_error);
  EXPECT_LT(begun, 1000);
}

TEST(TbbHost, ItsArenaOfTwoGivesEightNoMoreThanTwo) {
  const testing::UsedExecutor used("tbb");
  const tbb::global_control machine(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena(2);
  Crowd crowd;
  arena.execute([&] {
    EXPECT_EQ(internal::thread_count(8), 2);
    EXPECT_EQ(internal::thread_count(0), 2);
    EXPECT_EQ(internal::thread_count(1), 1);
    internal::parallel_for(100, 8, [&](std::size_t) { crowd.visit(); });
  });
  EXPECT_EQ(crowd.visits(), 100);
  EXPECT_LE(crowd.most(), 2);
}

}  // namespace
}  // namespace landfall
