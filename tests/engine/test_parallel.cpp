#include "engine/base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "executors.hpp"
#include "landfall/error.hpp"
#include "random_world.hpp"
#include "rooms.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

using internal::parallel_for;
using testing::UsedExecutor;

// Each test at each executor of this build.
class ParallelFor : public ::testing::TestWithParam<std::string> {
  const UsedExecutor used_{GetParam()};
};

class SearchOnThreads : public ParallelFor {};

INSTANTIATE_TEST_SUITE_P(Executors, ParallelFor, ::testing::ValuesIn(testing::executor_names()),
                         [](const auto& of) { return of.param; });
INSTANTIATE_TEST_SUITE_P(Executors, SearchOnThreads, ::testing::ValuesIn(testing::executor_names()),
                         [](const auto& of) { return of.param; });

TEST_P(ParallelFor, VisitsEveryIndexOnce) {
  for (const int threads : {0, 1, 2, 7, 64}) {
    for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(count, threads, [&](std::size_t i) { ++visits[i]; });
      for (const std::atomic<int>& visit : visits) EXPECT_EQ(visit, 1) << threads << " threads, " << count;
    }
  }
}

TEST_P(ParallelFor, OneThreadGoesInOrder) {
  std::vector<std::size_t> order;
  parallel_for(5, 1, [&](std::size_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST_P(ParallelFor, LetsAnExceptionOut) {
  for (const int threads : {0, 1, 2}) {
    const auto run = [&] {
      parallel_for(100, threads, [](std::size_t i) {
        if (i == 41) throw Error(ErrorCode::invalid_argument, "forty-one");
      });
    };
    EXPECT_THROW(run(), Error) << threads;
  }
}

// The other threads of the region are inside of bodies then: they come to their end before it is out, and
// what they throw stays within. The first body throws as soon as another has begun, which goes on for long.
TEST_P(ParallelFor, LetsOneExceptionOutOfMany) {
  using std::chrono::steady_clock;
  for (const int threads : {0, 2, 7}) {
    const int most_begun = std::min(2, internal::thread_count(threads));
    const auto latest = steady_clock::now() + std::chrono::seconds(10);
    std::atomic<int> begun{0}, ended{0};
    const auto run = [&] {
      parallel_for(1000, threads, [&](std::size_t) {
        const bool first = begun++ == 0;
        while (first && begun < most_begun && steady_clock::now() < latest) std::this_thread::yield();
        if (!first) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        ++ended;
        throw std::runtime_error(first ? "first" : "later");
      });
    };
    try {
      run();
      FAIL() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "first") << threads;
    }
    EXPECT_EQ(ended, begun) << threads;
    EXPECT_GE(begun, most_begun) << threads;
    EXPECT_LT(begun, 1000) << threads;
  }
}

TEST_P(ParallelFor, UsesAsManyThreadsAsItSays) {
  for (const int threads : {1, 2}) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    const int expected = internal::thread_count(threads);
    // Each waits for the others, so that one quick thread cannot do it all; not for ever.
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    parallel_for(static_cast<std::size_t>(expected), threads, [&](std::size_t) {
      for (;;) {
        const std::scoped_lock lock(mutex);
        seen.insert(std::this_thread::get_id());
        if (static_cast<int>(seen.size()) == expected || std::chrono::steady_clock::now() > latest) break;
      }
    });
    EXPECT_EQ(static_cast<int>(seen.size()), expected);
  }
}

TEST_P(ParallelFor, Nests) {
  std::atomic<int> sum{0};
  parallel_for(10, 2, [&](std::size_t i) {
    parallel_for(10, 2, [&, i](std::size_t j) { sum += static_cast<int>(10 * i + j); });
  });
  EXPECT_EQ(sum, 4950);
}

// Nothing is printed where more threads are asked for than there are.
TEST_P(ParallelFor, IsSilent) {
  ::testing::internal::CaptureStderr();
  EXPECT_GE(internal::thread_count(0), 1);
  EXPECT_LE(internal::thread_count(1000), 1000);
  parallel_for(100, 1000, [](std::size_t) {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// Several callers find a map of which nothing is built yet, and all need everything at once.
TEST_P(SearchOnThreads, CallersShareAFreshMap) {
  const Scan scan =
      testing::look(PreparedMap(testing::furnished_room()), testing::full_circle(90), {2.31, 3.17, 0.4});
  SearchOptions options;
  options.rotation_step_rad = 0.1;
  const SearchResult expected = search(PreparedMap(testing::furnished_room()), {Anywhere{}}, scan, options);
  ASSERT_EQ(expected.verdict, Verdict::found);
  for (int round = 0; round < 5; ++round) {
    const PreparedMap fresh(testing::furnished_room());
    std::vector<SearchResult> results(6);
    std::vector<std::thread> callers;
    for (std::size_t i = 0; i < results.size(); ++i) {
      callers.emplace_back([&, i] {
        SearchOptions own = options;
        own.method = i % 2 == 0 ? "branch_and_bound" : "exhaustive";
        own.threads = static_cast<int>(i % 3);
        own.robot_radius_m = i == 5 ? 1e-3 : 0.0;  // its own mask of free cells, the same cells
        results[i] = search(fresh, {Anywhere{}}, scan, own);
      });
    }
    for (std::thread& caller : callers) caller.join();
    for (const SearchResult& result : results) testing::expect_same_answer(result, expected);
  }
}

// A host that calls from its own parallel tasks is not held up by ours.
TEST_P(SearchOnThreads, AnswersInsideTheCallersTasks) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = testing::look(map, testing::full_circle(90), {2.31, 3.17, 0.4});
  SearchOptions options;
  options.rotation_step_rad = 0.1;
  std::vector<SearchResult> results(8);
  const PreparedMap fresh(testing::furnished_room());
  parallel_for(results.size(), 2,
               [&](std::size_t i) { results[i] = search(fresh, {Anywhere{}}, scan, options); });
  for (const SearchResult& result : results) testing::expect_same_answer(result, results.front());
}

// The same bits whoever schedules, with one scan and with a batch.
TEST_P(SearchOnThreads, AnswersAsInOneThread) {
  for (std::uint64_t seed = 3000; seed < 3008; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto ask = [seed](int threads) {
      const testing::World fresh = seed % 2 == 0 ? testing::large_world(seed) : testing::small_world(seed);
      SearchOptions options = fresh.options;
      options.threads = threads;
      std::vector<SearchResult> answers{
          testing::answer_or_error(fresh.map, fresh.prior, fresh.scan, options)};
      if (answers.front().method.empty()) return answers;  // refused
      for (SearchResult& one : search(fresh.map, fresh.prior, std::vector(3, fresh.scan), options))
        answers.push_back(std::move(one));
      return answers;
    };
    const SearchResult expected = ask(1).front();
    for (const int threads : {1, 2, 4})
      for (const SearchResult& answer : ask(threads)) testing::expect_same_answer(answer, expected);
  }
}

}  // namespace
}  // namespace landfall
