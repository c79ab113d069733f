// SPDX-License-Identifier: Apache-2.0
// One process in a results folder, or several shards; what dead ones leave is no obstacle.
#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/folder/lock/heartbeat.hpp"
#include "ensemble/workflow/folder/lock_file.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using workflow::FolderLock;
using workflow::OutputFolder;

/// A child process that does something and then waits to be ended.
class Child {
 public:
  explicit Child(const std::function<bool()>& work) {
    int ends[2] = {};
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      char done = 'n';
      try {
        done = work() ? 'y' : 'n';
      } catch (const SetupError&) {
      }
      if (write(ends[1], &done, 1) != 1) _exit(1);
      pause();
      _exit(0);
    }
    char said = 0;
    worked_ = read(ends[0], &said, 1) == 1 && said == 'y';
    close(ends[0]);
    close(ends[1]);
  }
  ~Child() { end(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  bool worked() const { return worked_; }
  pid_t pid() const { return pid_; }
  void end() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

 private:
  pid_t pid_ = -1;
  bool worked_ = false;
};

class Lock : public Workflow {
 protected:
  OutputFolder folder() const { return {path("out")}; }
  /// A child that holds the lock of the folder, or of a shard of it that has begun.
  std::unique_ptr<Child> holder(workflow::Shard shard = {}) const {
    const OutputFolder where = folder();
    return std::make_unique<Child>([where, shard] {
      static std::shared_ptr<FolderLock> held;
      held =
          shard.n > 1 ? FolderLock::shard(where, shard, "test") : FolderLock::alone(where, "test");
      held->others_may_come();
      return true;
    });
  }
  std::string refusal(const std::function<void()>& work) const {
    try {
      work();
    } catch (const SetupError& refused) {
      return refused.what();
    }
    return "not refused";
  }
  std::string refusal() const {
    return refusal([&] { FolderLock::alone(folder(), "test"); });
  }
  /// Writes a lock as another process might have left it.
  void leave(const std::function<void(nlohmann::json&)>& change) const {
    nlohmann::json lock;
    {
      const auto mine = FolderLock::alone(folder(), "test");
      lock = nlohmann::json::parse(read("out/lock.json"));
    }
    change(lock);
    write("out/lock.json", lock.dump());
  }
};

TEST_F(Lock, IsThereWhileTheWorkIsAndGoneAfterwards) {
  {
    const auto held = FolderLock::alone(folder(), "ensemble s.yaml");
    const auto lock = nlohmann::json::parse(read("out/lock.json"));
    EXPECT_EQ(lock.at("pid"), getpid());
    EXPECT_EQ(lock.at("purpose"), "ensemble s.yaml");
    EXPECT_FALSE(lock.at("host").get<std::string>().empty());
    EXPECT_FALSE(lock.at("since").get<std::string>().empty());
  }
  EXPECT_FALSE(exists("out/lock.json"));
  EXPECT_TRUE(std::filesystem::is_empty(path("out"))) << "the lock left something behind";
}

TEST_F(Lock, AnotherProcessIsNamed) {
  auto child = holder();
  ASSERT_TRUE(child->worked());
  const std::string refused = refusal();
  EXPECT_THAT(refused, HasSubstr("process " + std::to_string(child->pid())));
  EXPECT_THAT(refused, HasSubstr("Wait for it"));
  child->end();
  EXPECT_EQ(refusal(), "not refused") << "the lock of a process that was killed";
}

TEST_F(Lock, AProcessOfTheSameNumberIsNotTheSame) {
  leave([](nlohmann::json& lock) { lock["start"] = lock.at("start").get<std::uint64_t>() - 1; });
  EXPECT_EQ(refusal(), "not refused");
  leave([](nlohmann::json& lock) { lock["boot"] = "an earlier start of this machine"; });
  EXPECT_EQ(refusal(), "not refused");
}

TEST_F(Lock, AnotherMachineThatNeverBeatsCannotBeJudged) {
  for (const char* other : {"host", "machine", "pids"}) {
    leave([&](nlohmann::json& lock) {
      lock[other] = "another one";
      lock.erase("beat_s");  // as versions before wrote it
    });
    EXPECT_THAT(refusal(), HasSubstr("delete " + path("out/lock.json").string())) << other;
    std::filesystem::remove(path("out/lock.json"));
  }
  EXPECT_EQ(refusal(), "not refused");
}

TEST_F(Lock, AnotherMachineIsGoneWhenItHasBeenSilent) {
  leave([](nlohmann::json& lock) { lock["host"] = "another one"; });
  const auto silence = std::chrono::seconds(100);
  std::filesystem::last_write_time(path("out/lock.json"),
                                   std::filesystem::file_time_type::clock::now() - silence);
  EXPECT_EQ(refusal(), "not refused");
  leave([](nlohmann::json& lock) {
    lock["host"] = "another one";
    lock["beat_s"] = 0.1;
  });
  EXPECT_EQ(refusal(), "not refused") << "a second of listening, and it was silent";
}

TEST_F(Lock, AnotherMachineThatBeatsIsNotDisturbed) {
  leave([](nlohmann::json& lock) {
    lock["host"] = "another one";
    lock["beat_s"] = 0.5;
  });
  workflow::Heartbeat other(std::chrono::milliseconds(100));
  other.keep(path("out/lock.json"),
             nlohmann::json::parse(read("out/lock.json")).at("token").get<std::string>());
  const std::string refused = refusal();
  EXPECT_THAT(refused, HasSubstr("Its lock beats"));
  EXPECT_THAT(refused, HasSubstr("on another one since"));
  EXPECT_FALSE(other.lost());
}

TEST_F(Lock, ARequeuedJobDoesNotWaitForItsOwnEarlierStart) {
  auto zombie = std::make_unique<Child>([where = folder()] {
    workflow::this_process_is_of("slurm/test/17", 0);
    static std::shared_ptr<FolderLock> held;
    held = FolderLock::shard(where, {2, 3}, "test");
    held->others_may_come();
    return true;
  });
  ASSERT_TRUE(zombie->worked());
  const auto started = [&](const char* job, int restarts) {
    return Child([where = folder(), job, restarts] {
             workflow::this_process_is_of(job, restarts);
             FolderLock::shard(where, {2, 3}, "test");
             return true;
           })
        .worked();
  };
  EXPECT_FALSE(started("slurm/test/17", 0)) << "the same start twice";
  EXPECT_FALSE(started("slurm/test/18", 1)) << "another job";
  EXPECT_FALSE(started("", 1)) << "no job";
  EXPECT_TRUE(started("slurm/test/17", 1));
}

TEST_F(Lock, WhoIsTakenForGoneKnowsItAndLeavesTheNewLockAlone) {
  const auto held = FolderLock::alone(folder(), "test");
  held->require_ours();
  const auto lock = nlohmann::json::parse(read("out/lock.json"));
  workflow::Heartbeat heart(std::chrono::milliseconds(10));
  heart.keep(path("out/lock.json"), lock.at("token").get<std::string>());
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(heart.lost());
  auto other = lock;
  other["token"] = "0123456789abcdef";
  write("out/lock.json", other.dump());
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!heart.lost() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(heart.lost());
  EXPECT_EQ(read("out/lock.json"), other.dump());
}

TEST_F(Lock, SaysHowManyMembersAreComputedAtATime) {
  const auto held = FolderLock::alone(folder(), "test");
  held->say_workers(3);
  const auto found = workflow::holder_in(path("out/lock.json"));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->workers, 3);
  EXPECT_EQ(found->beat_s, 5);
}

TEST_F(Lock, ATokenThatIsNoNameOfAFileIsDamage) {
  for (const char* token : {"../../elsewhere", "a/b", ""}) {
    leave([&](nlohmann::json& lock) {
      lock["boot"] = "an earlier start of this machine";
      lock["token"] = token;
    });
    EXPECT_THAT(refusal(), HasSubstr("not a lock that sturz wrote, or damaged")) << token;
    std::filesystem::remove(path("out/lock.json"));
  }
}

TEST_F(Lock, SomethingElseOfThatNameIsNotRemoved) {
  std::filesystem::create_directory(path("out"));
  write("out/lock.json", "{\"mine\": 1}");
  EXPECT_THAT(refusal(), HasSubstr("not a lock that sturz wrote"));
  EXPECT_EQ(read("out/lock.json"), "{\"mine\": 1}");
}

TEST_F(Lock, ShardsWorkSideBySideAndNothingElseBesideThem) {
  auto first = holder({1, 3});
  auto second = holder({2, 3});
  EXPECT_TRUE(first->worked());
  EXPECT_TRUE(second->worked()) << "two shards of one folder";
  EXPECT_THAT(refusal(), HasSubstr("another sturz works there"));
  EXPECT_THAT(refusal([&] {
                FolderLock::shard(folder(), {2, 3}, "test");
              }),
              HasSubstr("process " + std::to_string(second->pid())));
  first->end();
  second->end();
  EXPECT_EQ(refusal(), "not refused");
  EXPECT_TRUE(std::filesystem::is_empty(path("out")));
}

TEST_F(Lock, AShardDoesNotComeToOneThatIsAlone) {
  auto child = holder();
  EXPECT_THAT(refusal([&] {
                FolderLock::shard(folder(), {1, 2}, "test");
              }),
              HasSubstr("process " + std::to_string(child->pid())));
}

TEST_F(Lock, OfManyThatFindADeadOneExactlyOneGetsIt) {
  for (int round = 0; round < 5; ++round) {
    auto dead = holder();
    ASSERT_TRUE(dead->worked());
    dead->end();
    int gate[2] = {};
    ASSERT_EQ(pipe(gate), 0);
    int result[2] = {};
    ASSERT_EQ(pipe(result), 0);
    std::vector<pid_t> children;
    for (int i = 0; i < 6; ++i) {
      const pid_t child = fork();
      if (child == 0) {
        close(gate[1]);
        char go = 0;
        if (::read(gate[0], &go, 1) > 0) _exit(1);  // ends when the parent opens the gate
        std::shared_ptr<FolderLock> lock;
        try {
          lock = FolderLock::alone(folder(), "test");
        } catch (const SetupError&) {
        }
        const char got = lock ? 'y' : 'n';
        if (::write(result[1], &got, 1) != 1) _exit(1);
        pause();
      }
      children.push_back(child);
    }
    close(gate[0]);
    close(gate[1]);
    int winners = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
      char got = 0;
      ASSERT_EQ(::read(result[0], &got, 1), 1);
      winners += got == 'y';
    }
    for (const pid_t child : children) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
    close(result[0]);
    close(result[1]);
    EXPECT_EQ(winners, 1) << round;
  }
}

TEST_F(Lock, ClearsAwayHalfWrittenFilesOfTheDead) {
  std::filesystem::create_directories(path("out/members"));
  write("out/members/000001.nc.0123456789abcdef.part", "half");
  write("out/.0123456789abcdef.part", "half");
  write("out/members/mine.part", "a user's own");
  FolderLock::alone(folder(), "test");
  EXPECT_FALSE(exists("out/members/000001.nc.0123456789abcdef.part"));
  EXPECT_FALSE(exists("out/.0123456789abcdef.part"));
  EXPECT_TRUE(exists("out/members/mine.part"));
}

}  // namespace
}  // namespace sturz::test
