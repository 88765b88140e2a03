//! The rules of the protocol and the hazards that they are for, as scripts: robots on a street, what they are told, and what
//! they say.
#![allow(clippy::wildcard_imports, reason = "scripts use the whole vocabulary")]

mod allocation;
mod availability;
mod commands;
mod completion;
mod corridor;
mod corridor_before_the_blocker_is_in_place;
mod crossing;
mod duty_outlives_its_session;
mod ends_that_say_how;
mod every_guard_counts;
mod execution_limit;
mod fallback;
mod guard_that_leaves_its_position;
mod guard_that_sees_more_than_its_leader;
mod help;
mod identity;
mod incomplete_team_without_a_fault;
mod late_messages_of_a_current_session;
mod leader_that_hangs;
mod leases;
mod leaving;
mod not_enough_time_to_cross;
mod numbers_that_a_peer_cannot_use_up;
mod paper;
mod reading;
mod reissue_after_a_fallback;
mod renewal_waits_for_the_road;
mod script;
mod selection_when_all_have_answered;
mod serialization;
mod sessions;
mod team;
mod timers_that_do_not_fit;
mod two_leaders_at_one_place;
mod two_requesters;
mod valid;
