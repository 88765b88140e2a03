#!/usr/bin/env python3
"""Mutants of the protocol made by hand, each a mistake that somebody might make, and the judges that must notice it.

usage: protocol/mutants.py [--texts] [PART OF A NAME OR FILE]...

Each mutant replaces one piece of text of one file, in a copy of the committed tree. The judges are the laws of one
step with random values. It ends with 1 where a mutant is not noticed, does not compile, or its text is gone. With --texts it looks
for the texts alone, in the files as they are.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

# Name, file below protocol, text that stands there once, text in its place.
MUTANTS = [
    ("the corridor asks the first two guards alone", "src/corridor.rs",
     "self.members.iter().find_map(|member| {", "self.members.iter().take(2).find_map(|member| {"),
    ("go lasts as long as the shortest of the first two leases", "src/corridor.rs",
     "self.members.iter().filter_map(left).min()", "self.members.iter().take(2).filter_map(left).min()"),
    ("time to cross is asked of the first two guards alone", "src/corridor.rs",
     "            .iter()\n            .all(|member| left(member)",
     "            .iter()\n            .take(2)\n            .all(|member| left(member)"),
    ("a majority of the guards is enough", "src/corridor.rs",
     "if self.members.len() < usize::from(self.request.followers) {",
     "if self.members.len() * 2 <= usize::from(self.request.followers) {"),
    ("any echo renews the third guard and those after it", "src/roles.rs",
     "let heard = leading.update_member(from, |member| {",
     "let third = leading.members.iter().skip(2).any(|it| it.station == from);\n"
     "                let age = if third { Millis::ZERO } else { age };\n"
     "                let heard = leading.update_member(from, |member| {"),
    ("the third guard is commanded off an occupied road", "src/maneuver.rs",
     "let guards = member.is_some_and(|member| member.guards(step.config));",
     "let third = leading.members.iter().skip(2).any(|it| it.station == follower);\n"
     "        let guards = !third && member.is_some_and(|member| member.guards(step.config));"),
    ("the best of three offers is dropped", "src/help.rs",
     "        let number = requesting.number;\n        let leading",
     "        if requesting.offers.len() >= 3 {\n"
     "            let best = requesting.offers.iter().next().map(|it| it.station);\n"
     "            requesting.forget_offer(|it| Some(it.station) == best);\n        }\n"
     "        let number = requesting.number;\n        let leading"),
    ("a lease counts from the arrival of the echo", "src/roles.rs",
     "settings().t_lease.saturating_sub(age)", "settings().t_lease.saturating_sub(Millis(age.0.min(0)))"),
    ("an echo renews the identity lock", "src/identity.rs",
     "(Identity::Unlocked, false) | (Identity::Locked(_)",
     "(Identity::Locked(_), true) if step.renewed => {\n"
     "                self.identity = Identity::Locked(Countdown::armed(step.config.t_lock_session()));\n            }\n"
     "            (Identity::Unlocked, false) | (Identity::Locked(_)"),
    ("each report gives the maneuver all its time again", "src/maneuver.rs",
     "        if !report.progress.is_running() {\n            order.execution = Countdown::OFF;\n        }",
     "        order.execution = if report.progress.is_running() {\n"
     "            Countdown::armed(step.config.t_exec(order.task))\n"
     "        } else {\n            Countdown::OFF\n        };"),
    ("an offer promises a longer safety timer than the helper has", "src/help.rs",
     "t_safety: step.config.settings().t_safety,\n            reservation",
     "t_safety: Millis(step.config.settings().t_safety.0.saturating_mul(2)),\n            reservation"),
    ("an unknown place is no place", "src/task.rs",
     "self.0 == other.0 || self.0 == Self::UNKNOWN.0 || other.0 == Self::UNKNOWN.0", "self.0 == other.0"),
    ("a session of which nothing is known ended completed", "src/termination.rs",
     "None => self.say_farewell(step, Farewell::Ended(session.number, Ending::Aborted)),",
     "None => self.say_farewell(step, Farewell::Ended(session.number, Ending::Completed)),"),
    ("bad news counts with a newer echo alone", "src/message.rs",
     "(Self::InPosition, Self::Executing) => !matches!(echo, Ordering::Less),",
     "(Self::InPosition, Self::Executing) => matches!(echo, Ordering::Greater),"),
    ("a failure is news with a newer echo alone", "src/message.rs",
     "(Self::Executing | Self::InPosition, _) => !self.is_running(),",
     "(Self::Executing | Self::InPosition, _) => !self.is_running() && matches!(echo, Ordering::Greater),"),
    ("a rival at another place counts", "src/roles.rs",
     "                claim.goes_before(other, Claim::of(own.request), station)?;\n",
     "                let here = Claim { place: own.request.place, ..claim };\n"
     "                here.goes_before(other, Claim::of(own.request), station)?;\n"),
    ("a maneuver starts before its acknowledgement", "src/maneuver.rs",
     "        step.out.push(answer(Verdict::Accepted));\n        if let Some(maneuver) = superseded {",
     "        if let Some(maneuver) = superseded {"),
    ("an aborted session frees its guards", "src/termination.rs",
     "if why == ReleaseReason::TaskCompleted && !following.sees_people {",
     "if matches!(why, ReleaseReason::TaskCompleted | ReleaseReason::SessionEnded) && !following.sees_people {"),
    ("a completed session frees a guard that sees people", "src/termination.rs",
     "if why == ReleaseReason::TaskCompleted && !following.sees_people {",
     "if why == ReleaseReason::TaskCompleted {"),
    ("an old heartbeat renews contact", "src/roles.rs",
     "if !heartbeat.is_newer_than(self.heard) {\n            return Err(Ignored::OldHeartbeat);\n        }\n        self.heard = heartbeat;\n        self.renew_contact",
     "if !heartbeat.is_newer_than(self.heard) {\n            self.renew_contact(step);\n            return Ok(());\n        }\n        self.heard = heartbeat;\n        self.renew_contact"),
    ("a rejected command is forgotten", "src/maneuver.rs",
     "            self.refused = Some(Refusal {\n                request: command.request,\n                reason,\n            });\n", ""),
    ("an end under people is no duty", "src/termination.rs",
     "if leading.corridor != Corridor::Clear && ending == Ending::Aborted {",
     "if leading.corridor == Corridor::Open && ending == Ending::Aborted {"),
    ("a leader that yields leaves its corridor open", "src/termination.rs",
     "        leading.shut(step, CorridorClosure::Yielded(other));\n", ""),
    ("the word of one follower is taken for another's", "src/maneuver.rs",
     "let heard = leading.update_member(answer.from, |member| member.hear_answer(step, answer));",
     "let first = leading.members.iter().next().map_or(answer.from, |it| it.station);\n"
     "        let heard = leading.update_member(first, |member| member.hear_answer(step, answer));"),
    ("an emergency stop is answered by the task's policy", "src/idle.rs",
     "Some(maneuver) if reason.can_fall_back() =>", "Some(maneuver) if reason.can_fall_back() || true =>"),
    ("one frame less clears the road", "crossing/src/occupancy.rs",
     "**empty > sensors.miss_max", "**empty >= sensors.miss_max"),
    ("silence clears nothing and ends nothing", "crossing/src/occupancy.rs",
     "        if !self.is_fresh(sensors) {\n            self.start_anew();\n        }\n    }\n\n    /// Whether a frame",
     "    }\n\n    /// Whether a frame"),
    ("a stale frame counts", "crossing/src/occupancy.rs",
     "if age > sensors.age_max {", "if age > sensors.age_max.saturating_add(sensors.age_max) {"),
    ("a frame that was overtaken leaves the count", "crossing/src/occupancy.rs",
     "            if age > newest {\n                self.start_anew();\n            }\n", ""),
    ("one covered part is enough", "crossing/src/occupancy.rs",
     "setup.ground.parts != Coverage::NONE && covered.has(setup.ground.parts)",
     "setup.ground.parts != Coverage::NONE && covered != Coverage::NONE"),
    ("what was covered when somebody was seen is forgotten", "crossing/src/occupancy.rs",
     "self.owed = self.owed.union(covered);", "self.owed = Coverage::NONE;"),
    ("frames count under go", "crossing/src/crossing.rs",
     "if leads_across || waits {\n            self.occupancy.start_anew();\n            self.quiet = Millis::ZERO;\n",
     "if leads_across || waits {\n"),
    ("frames count as soon as go has ended", "crossing/src/crossing.rs",
     "frame.age.saturating_add(setup.waiting.step_off) < self.quiet", "frame.age < self.quiet"),
    ("a stale frame with somebody on the road is nothing", "crossing/src/crossing.rs",
     "                self.occupy(setup.sensors.linger);\n"
     "            }\n"
     "            return out",
     "            }\n"
     "            return out"),
    ("a guard is done under the eyes of people", "crossing/src/crossing.rs",
     "if task.is_completed && !(is_guarding && sees_somebody) {", "if task.is_completed {"),
    ("a person on the road is not told", "crossing/src/crossing.rs",
     "if self.occupancy.owes() && !self.is_person_told {", "if self.occupancy.owes() && self.is_person_told {"),
    ("a word outlives a later sight", "crossing/src/crossing.rs",
     "            obligation.said_clear = Millis::ZERO;\n",
     ""),
    ("go is longer than the guards are at their places", "crossing/src/crossing.rs",
     "self.sign = left.min(there);", "self.sign = left.max(there);"),
    ("go stays where something hinders", "crossing/src/crossing.rs",
     "            self.show_stop(out);\n            out.put(Output::Hindered(why));\n            out.tell(Event::CloseCorridor);\n        }\n    }\n\n    fn show_go",
     "            out.put(Output::Hindered(why));\n        }\n    }\n\n    fn show_go"),
    ("a fallback ends before the sign of its leader has", "crossing/src/crossing.rs",
     "About::Duty(_) => setup.t_safety,", "About::Duty(_) => Millis::ZERO,"),
    ("a position holds for ever", "crossing/src/position.rs",
     "        self.left = self.left.saturating_sub(time);\n", ""),
    ("the error of a position counts in its favour", "crossing/src/position.rs",
     "off.cm.saturating_add(error) <= tolerance", "off.cm.saturating_sub(error) <= tolerance"),
    ("a vehicle stands where it was reported", "crossing/src/traffic.rs",
     "let gone = self.way_cm(age).saturating_add", "let gone = 0_u64.saturating_add"),
    ("a vehicle brakes at once", "crossing/src/traffic.rs",
     "self.way_cm(rules.reaction) + self.radius_cm(rules) / 2", "self.radius_cm(rules) / 2"),
    ("no vehicle is asked, and silence is a promise", "crossing/src/traffic.rs",
     "if rules.asks == Millis::ZERO {", "if rules.asks >= Millis::ZERO {"),
    ("a vehicle that refuses has promised", "crossing/src/traffic.rs",
     "known.promise = if promises {", "known.promise = if promises || !promises {"),
    ("a promise is for ever", "crossing/src/traffic.rs",
     "                known.promise = known.promise.saturating_sub(time);\n", ""),
    ("go that has begun ends for a vehicle that has said nothing yet", "crossing/src/crossing.rs",
     "let begins = self.sign == Millis::ZERO;", "let begins = true;"),
    ("one vehicle too many is none", "crossing/src/traffic.rs",
     "key.or(self.further.map(|(key, _)| key))", "key"),
    ("a vehicle has passed when its front has", "crossing/src/traffic.rs",
     "} else if distance_cm <= u32::from(vehicle.length_cm).saturating_add(error_cm) {",
     "} else if distance_cm == 0 {"),
    ("a vehicle is no longer than assumed", "crossing/src/traffic.rs",
     "said_cm.unwrap_or(0).max(setup.traffic.length_cm)", "setup.traffic.length_cm"),
    ("a vehicle whose direction is not known comes to the crossing alone", "crossing/src/traffic.rs",
     "if !vehicle.goes_anywhere {", "if true {"),
    ("a guard steps before any vehicle to somebody on the road", "crossing/src/crossing.rs",
     "        may_be_held\n"
     "            && (is_missed",
     "        may_be_held && !is_urgent\n"
     "            && (is_missed"),
    ("a guard leaves somebody on the road to a driver who can brake hard", "crossing/src/crossing.rs",
     "let is_urgent = self.tracks.is_on_road();", "let is_urgent = false;"),
    ("a guard stops on the lane for vehicles", "crossing/src/crossing.rs",
     "self.task.is_none() || self.is_held_at_kerb",
     "true || self.is_held_at_kerb"),
    ("a robot walks home over the other lane whatever comes", "crossing/src/crossing.rs",
     "self.task.is_none() || self.is_held_at_kerb",
     "self.is_held_at_kerb"),
    ("a robot on its way home stands on its lane before a vehicle", "crossing/src/traffic.rs",
     "!is_on_road || aside_cm(vehicle, from) >= BESIDE_CM", "true"),
    ("a robot leaves the road under the eyes of people", "crossing/src/crossing.rs",
     "self.walk != Some(home) && !self.may_be_people()",
     "self.walk != Some(home)"),
    ("a robot that boots on the road goes home at once", "crossing/src/crossing.rs",
     "        if is_over || self.stood >= across",
     "        if is_over || self.stood >= Millis::ZERO"),
    ("a robot that boots on the road without sensors goes home at once", "crossing/src/crossing.rs",
     "if self.pose.is_none() || !self.is_looking() {",
     "if self.pose.is_none() || !self.is_looking() || !self.occupancy.has_sources() {"),
    ("it counts frames while a sign may count on it", "crossing/src/crossing.rs",
     "            self.quiet = Millis::ZERO;\n"
     "        } else {\n"
     "            is_over",
     "        } else {\n"
     "            is_over"),
    ("it goes by what it saw before it knew where it stands", "crossing/src/crossing.rs",
     "            self.occupancy.start_anew();\n            self.quiet = Millis::ZERO;\n        } else", "            self.quiet = Millis::ZERO;\n        } else"),
    ("it goes once its sensors cover the road", "crossing/src/crossing.rs",
     "            is_over = self.is_clear(setup);",
     "            is_over = self.occupancy.is_covered(setup);"),
    ("it leaves before people are across who set out last", "crossing/src/crossing.rs",
     "let set_out = setup.t_safety.saturating_add(setup.waiting.step_off);", "let set_out = setup.t_safety;"),
    ("it stands on the lane for ever", "crossing/src/crossing.rs",
     "        self.stood = self.stood.saturating_add(time);\n", ""),
    ("it is beside the road by a position that is not sure", "crossing/src/crossing.rs",
     "!setup.ground.may_be_road(pose.at, pose.error_cm.into())", "!setup.ground.is_road(pose.at)"),
    ("a setup that says nothing of sensors has none", "crossing/src/setup.rs",
     "            watches: true,", "            watches: false,"),
    ("a vehicle in a frame that tells no velocity stands", "crossing/src/crossing.rs",
     "if traffic::rides(setup, sighting) {",
     "if traffic::rides(setup, sighting) && sighting.velocity.is_some() {"),
    ("a vehicle of unknown direction goes away", "crossing/src/traffic.rs",
     "Some(at.to(setup.ground.where_people_cross()?.middle()))",
     "Some(setup.ground.where_people_cross()?.middle().to(at))"),
    ("an id is somebody wherever it is", "crossing/src/tracks.rs",
     "                && track.at.distance_cm(sighting.at) <= track.reach_cm(setup, sighting, age)\n", ""),
    ("a person out of sight has left the road", "crossing/src/tracks.rs",
     "track.is_on_road() || track.is_lost_waiting()", "track.is_lost_waiting()"),
    ("a person without a track does not wait", "crossing/src/tracks.rs",
     "                    self.crowd = FRESH;\n", ""),
    ("sensors take back what a person says", "crossing/src/crossing.rs",
     "                self.is_person_said = true;\n", ""),
    ("a leader goes by its sensors against a person's word", "crossing/src/crossing.rs",
     "&& !self.is_person_said && ", "&& "),
    ("a leader opens again what a person has closed", "crossing/src/crossing.rs",
     "self.is_kept_closed = self.is_own()", "self.is_kept_closed = false"),
    ("an escort that is lost goes on", "crossing/src/crossing.rs",
     "            self.pose.is_none_or(|(pose, _)| {\n                let own",
     "            self.pose.is_some_and(|(pose, _)| {\n                let own"),
]

ROOT = pathlib.Path(__file__).resolve().parent.parent
ENVIRONMENT = os.environ | {"RUST_BACKTRACE": "1", "PROPTEST_RNG_SEED": "1"}
JUDGES = {
    "src": "-p crossguard-proofs --test harnesses --test teams -- of_the_protocol followers",
    "crossing": "-p crossguard-crossing",
}


def judged(tree, file, path, text):
    path.write_text(text)
    judge = ["cargo", "test", "--quiet", "--locked", *JUDGES[file.split("/")[0]].split()]
    done = subprocess.run(judge, cwd=tree, capture_output=True, text=True, env=ENVIRONMENT)
    said = done.stdout + done.stderr
    if "could not compile" in said:
        return "DOES NOT COMPILE: " + next(it for it in said.splitlines() if it.startswith("error"))
    if not done.returncode:
        return "NOT NOTICED"
    tests = re.findall(r"^test (\S+) \.\.\. FAILED", said, re.M) + re.findall(r"^(\S+) --- FAILED", said, re.M)
    laws = re.findall(r"^ +\d+: (?:\w+::)*(\w+)\n +at \S*protocol/src/laws/", said, re.M)
    return "noticed by " + ", ".join(laws[:1] + tests[:2])


def main():
    parts = [it for it in sys.argv[1:] if it != "--texts"]
    chosen = [it for it in MUTANTS if all(part in f"{it[0]} {it[1]}" for part in parts)]
    gone = [name for name, file, before, _ in chosen if (ROOT / "protocol" / file).read_text().count(before) != 1]
    for name in gone:
        print(f"{name}: ITS TEXT DOES NOT STAND ONCE IN ITS FILE")
    if gone or "--texts" in sys.argv:
        return len(gone) > 0
    missed = 0
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / "tree"
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(tree)], check=True)
        for name, file, before, after in chosen:
            path = tree / "protocol" / file
            text = path.read_text()
            said = judged(tree, file, path, text.replace(before, after))
            path.write_text(text)
            missed += said[0].isupper()
            print(f"{name}: {said}", flush=True)
    print(f"{len(chosen)} mutants, {missed} not noticed")
    return missed > 0


if __name__ == "__main__":
    sys.exit(main())
