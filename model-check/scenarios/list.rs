// The scenarios that come with the kit, one line each: how long a check takes, whether time passes in it, the name
// of its test, its file. Each quick one without time has a test of that name in `tests/scenarios.rs`.
shipped! {
    quick plain pair "pair";
    quick plain contention "contention";
    long plain pair_reboot "pair-reboot";
    quick plain leader_crash "leader-crash";
    quick plain offer_race "offer-race";
    quick plain bilateral "bilateral";
    quick plain trio "trio";
    quick plain pair_monotone "pair-monotone";
    quick plain contention_monotone "contention-monotone";
    quick plain pair_hang "pair-hang";
    quick plain contention_urgency "contention-urgency";
    quick timed timed_pair "timed-pair";
    quick timed timed_trio "timed-trio";
    quick timed timed_hang "timed-hang";
    quick timed timed_wait "timed-wait";
    quick timed timed_rivals "timed-rivals";
    quick plain wrap "wrap";
    quick plain stable "stable";
    quick plain blocker "blocker";
    quick plain trio_corridor "trio-corridor";
    quick plain corridor_of_four "corridor-of-four";
    quick plain drift "drift";
    quick plain own_sight "own-sight";
    quick plain two_teams "two-teams";
    quick plain crossing "crossing";
    quick plain rivals "rivals";
    quick plain outsider "outsider";
    quick plain lying_follower "lying-follower";
    quick plain lying_helper "lying-helper";
    quick plain lying_leader "lying-leader";
    quick plain lying_bystander "lying-bystander";
    long plain trio_delayed "trio-delayed";
    long plain team_of_four "team-of-four";
    long plain team_symmetric "team-symmetric";
    long plain team_of_six "team-of-six";
    long plain corridor_of_five "corridor-of-five";
    long timed timed_in_use "timed-in-use";
    long timed timed_trio_drift "timed-trio-drift";
    long timed timed_trio_delay "timed-trio-delay";
    large plain trio_late "trio-late";
    large plain trio_lossy "trio-lossy";
}
