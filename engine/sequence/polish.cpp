#include <optional>
#include <string>

#include "engine/base/options.hpp"
#include "engine/base/parallel.hpp"
#include "engine/refine/settle.hpp"
#include "engine/sequence/sequence_model.hpp"
#include "engine/verify/verify.hpp"
#include "landfall/consistent.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

using namespace internal;

constexpr std::size_t reach = 2;  // neighbours on either side

class Polisher {
 public:
  Polisher(std::span<const PreparedMap> maps, std::span<const Scan> scans,
           std::span<const SearchResult> results, std::span<const int> choice,
           const ConsistentOptions& options)
      : maps_(maps),
        scans_(scans),
        results_(results),
        choice_(choice),
        options_(options),
        model_(results, odometry_of(scans), options) {}

  // Where a scan that has a choice fits best among its neighbours; none: it stays.
  [[nodiscard]] std::optional<Pose2> T_map_polished(std::size_t here) const {
    std::size_t first = here;
    while (first > 0 && here - first < reach && are_tied(first - 1, first)) --first;
    std::size_t last = here;
    while (last + 1 < scans_.size() && last - here < reach && are_tied(last, last + 1)) ++last;
    if (first == last || scans_[here].parts) return std::nullopt;
    const std::span<const Scan> window = scans_.subspan(first, last - first + 1);
    const std::vector<Pose2> T_here_robot =
        align(window, here - first, {.odometry = options_.odometry, .threads = 1});
    const Scan composite = merge(window, T_here_robot, here - first, aligned_noise);
    std::vector<std::vector<Pose2>> starts(1);
    for (std::size_t i = first; i <= last; ++i) starts.front().push_back(chosen(i).T_map_robot);
    for (std::size_t i = 0; i < window.size(); ++i) {
      const Pose2 T_map_here = starts.front()[i] * inverse(T_here_robot[i]);
      std::vector<Pose2>& rigid = starts.emplace_back();
      for (const Pose2& T_here_other : T_here_robot) rigid.push_back(T_map_here * T_here_other);
    }
    return settle(SettleProblem(map_of(here), composite), starts)[here - first];
  }

  [[nodiscard]] const PreparedState& map_of(std::size_t i) const {
    return maps_[static_cast<std::size_t>(chosen(i).map_index)].state();
  }

 private:
  [[nodiscard]] const Hypothesis& chosen(std::size_t i) const {
    return results_[i].hypotheses[static_cast<std::size_t>(choice_[i])];
  }
  [[nodiscard]] bool are_tied(std::size_t before, std::size_t after) const {
    if (choice_[before] < 0 || choice_[after] < 0) return false;
    if (scans_[before].parts || scans_[after].parts) return false;
    return !model_.is_jump(chosen(before), chosen(after),
                           inverse(*scans_[before].T_odom_robot) * *scans_[after].T_odom_robot);
  }

  std::span<const PreparedMap> maps_;
  std::span<const Scan> scans_;
  std::span<const SearchResult> results_;
  std::span<const int> choice_;
  const ConsistentOptions& options_;
  SequenceModel model_;
};

}  // namespace

std::vector<SearchResult> polish(std::span<const PreparedMap> maps, std::span<const Scan> scans,
                                 std::span<const SearchResult> results, std::span<const int> choice,
                                 const ConsistentOptions& options, int threads) {
  check_sequence("polish", maps, scans, results);
  check_options("polish", options);
  validate_environment();
  if (choice.size() != results.size())
    throw Error(ErrorCode::invalid_argument, "polish: " + std::to_string(choice.size()) + " choices and " +
                                                 std::to_string(results.size()) +
                                                 " results, expected as many");
  for (std::size_t i = 0; i < choice.size(); ++i)
    if (choice[i] < -1 || choice[i] >= static_cast<int>(results[i].hypotheses.size()))
      throw Error(ErrorCode::invalid_argument,
                  "polish: choice " + std::to_string(i) + " is " + std::to_string(choice[i]) + " of " +
                      std::to_string(results[i].hypotheses.size()) + " hypotheses");
  std::vector<SearchResult> polished(results.begin(), results.end());
  const Polisher polisher(maps, scans, results, choice, options);
  parallel_for(results.size(), threads, [&](std::size_t i) {
    if (choice[i] < 0) return;
    const std::optional<Pose2> T_map_robot = polisher.T_map_polished(i);
    if (!T_map_robot) return;
    Hypothesis& chosen = polished[i].hypotheses[static_cast<std::size_t>(choice[i])];
    chosen.T_map_robot = *T_map_robot;
    chosen.explained = verify(polisher.map_of(i), scans[i], std::span(&*T_map_robot, 1)).front().explained;
  });
  return polished;
}

}  // namespace landfall
