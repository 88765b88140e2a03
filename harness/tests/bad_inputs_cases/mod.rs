//! The commands, and the files that they name.

/// A robot's file that is fine, and what is changed in copies of it.
pub(crate) struct RobotFiles {
    pub(crate) text: &'static str,
    /// Name of the copy, what is replaced, and by what.
    pub(crate) changes: &'static [(&'static str, &'static str, &'static str)],
}

pub(crate) const ROBOT: RobotFiles = RobotFiles {
    text: "\
name = \"ARI\"
station = 1
build = \"humanoid\"
boot_file = \"ari.boot\"
place = [0.0, -1.5]
speed = 3.0
autopilot = true

[link]
address = \"127.0.0.1:0\"
peers = []

[protocol]
t_safety = 2000

[battery]
charge_percent = 80.0

[people]
radius_m = 15.0
",
    changes: &[
        ("no-name.toml", "name = \"ARI\"\n", ""),
        ("empty-name.toml", "\"ARI\"", "\"\""),
        ("blank-name.toml", "\"ARI\"", "\"  \""),
        ("no-toml.toml", "name = \"ARI\"", "name ="),
        ("wrong-type.toml", "station = 1", "station = \"one\""),
        ("negative-station.toml", "station = 1", "station = -1"),
        ("large-station.toml", "station = 1", "station = 4294967296"),
        ("unknown-build.toml", "humanoid", "unicorn"),
        ("unknown-key.toml", "autopilot = true", "autopilott = true"),
        ("place-nan.toml", "[0.0, -1.5]", "[nan, 1e30]"),
        ("place-far.toml", "[0.0, -1.5]", "[0.0, 10001.0]"),
        ("place-one.toml", "[0.0, -1.5]", "[0.0]"),
        ("speed-zero.toml", "speed = 3.0", "speed = 0.0"),
        ("speed-nan.toml", "speed = 3.0", "speed = nan"),
        ("speed-inf.toml", "speed = 3.0", "speed = inf"),
        (
            "no-link.toml",
            "address = \"127.0.0.1:0\"\npeers = []\n",
            "",
        ),
        ("no-port.toml", "127.0.0.1:0", "127.0.0.1"),
        ("two-links.toml", "peers = []", "ethernet = \"eth0\""),
        ("timers.toml", "t_safety = 2000", "t_safety = 20"),
        ("negative-timer.toml", "t_safety = 2000", "t_safety = -1"),
        ("battery.toml", "80.0", "180.0"),
        ("radius.toml", "radius_m = 15.0", "radius_m = 1000.0"),
        (
            "crossing.toml",
            "autopilot",
            "crossing = \"somewhere\"\nautopilot",
        ),
        (
            "map-place.toml",
            "autopilot",
            "map_place = \"nowhere\"\nautopilot",
        ),
        (
            "site.toml",
            "[link]",
            "[site]\nlatitude = 91.0\nlongitude = 0.0\n\n[link]",
        ),
        (
            "revoked.toml",
            "autopilot",
            "revoked = \"text.toml\"\nautopilot",
        ),
        (
            "trust.toml",
            "autopilot",
            "trust_ros_graph = \"yes\"\nautopilot",
        ),
        ("boot-corrupt.toml", "ari.boot", "corrupt.boot"),
        ("boot-nowhere.toml", "ari.boot", "nowhere/ari.boot"),
    ],
};

pub(crate) const FILES: &[(&str, &str)] = &[
    ("empty.jsonl", ""),
    ("text.jsonl", "not a log\n"),
    ("other.jsonl", "{\"a\": 1}\n"),
    ("text.pcap", "not a capture\n"),
    ("text.json", "not json\n"),
    ("text.toml", "not toml\n"),
    ("people.jsonl", "not a person\n"),
    ("text.cert", "not a certificate\n"),
    ("corrupt.boot", "17\n"),
    (
        "no-robots.toml",
        "name = 'none'\nsummary = 'nobody'\nproperties = ['I2']\nrobots = []\n[request]\nfollowers = 1\n\
         tasks = ['move']\n[bounds]\ndetections = 1\n[channel]\ndelayed = 0\nloss = true\n",
    ),
    (
        "no-property.toml",
        "name = 'none'\nsummary = 'nobody'\nproperties = ['I99']\n[[robots]]\nstation = 1\ndetects = true\n\
         [[robots]]\nstation = 2\n[request]\nfollowers = 1\ntasks = ['move']\n[bounds]\ndetections = 1\n\
         [channel]\ndelayed = 0\nloss = true\n",
    ),
    (
        "unknown-place.toml",
        "summary = 'a guard and an escort'\n\
         [[roles]]\n\
         name = 'leader'\n\
         leads = true\n\
         [[roles]]\n\
         name = 'guard'\n\
         [[roles]]\n\
         name = 'escort'\n\
         [[stages]]\n\
         guard = { task = 'initialPos', to = 'nosuch' }\n\
         escort = { task = 'initialPos', to = [4.0, 0.2] }\n",
    ),
    (
        "unknown-task.toml",
        "summary = 'a guard and an escort'\n\
         [[roles]]\n\
         name = 'leader'\n\
         leads = true\n\
         [[roles]]\n\
         name = 'guard'\n\
         [[roles]]\n\
         name = 'escort'\n\
         [[stages]]\n\
         guard = { task = 'dance', to = [0.0, 0.0] }\n\
         escort = { task = 'initialPos', to = [4.0, 0.2] }\n",
    ),
    (
        "too-close.toml",
        "summary = 'a guard and an escort'\n\
         [[roles]]\n\
         name = 'leader'\n\
         leads = true\n\
         [[roles]]\n\
         name = 'guard'\n\
         [[roles]]\n\
         name = 'escort'\n\
         [[stages]]\n\
         guard = { task = 'initialPos', to = [4.0, 0.5] }\n\
         escort = { task = 'initialPos', to = [4.0, 0.2] }\n",
    ),
];

type Case = (&'static str, i32);

/// By command. Two quotes are an empty word.
pub(crate) const CASES: &[(&str, &[Case])] = &[
    ("crossguard", &[("nosuch", 2), ("--nosuch", 2)]),
    (
        "demo",
        &[
            ("demo --speed 0", 2),
            ("demo --speed -3", 2),
            ("demo --speed nan", 2),
            ("demo --speed inf", 2),
            ("demo --speed fast", 2),
            ("demo --speed 101", 2),
            ("demo --loss -0.1", 2),
            ("demo --loss 0.95", 2),
            ("demo --loss nan", 2),
            ("demo --trials 0", 2),
            ("demo --trials -1", 2),
            ("demo --trials many", 2),
            ("demo --seed -1", 2),
            ("demo --seed 1.5", 2),
            ("demo --port 80", 2),
            ("demo --port 65600", 2),
            ("demo --scenario nosuch", 2),
            ("demo --followers 2", 2),
            ("demo --scenario team --followers 0", 2),
            ("demo --scenario team --followers 17", 2),
            ("demo --scenario leader-dies --trials 2", 2),
            ("demo --faults burst=2", 2),
            ("demo --faults nosuch=1", 2),
            ("demo --faults delay=9..1", 2),
            ("demo --security maybe", 2),
            ("demo --pki folder", 2),
            ("demo --security sign --pki nosuch", 2),
            ("demo --pseudonym-period -1", 2),
            ("demo --perceived nosuch.jsonl", 2),
            ("demo --log nosuch/log.jsonl", 2),
            ("demo --log folder", 2),
            ("demo --log text.toml/log.jsonl", 2),
            ("demo --pcap nosuch/demo.pcap", 2),
            ("demo --report nosuch/report.html", 2),
            ("demo --mcap nosuch/demo.mcap", 2),
            ("demo --report ''", 2),
            ("demo --json --quiet", 2),
        ],
    ),
    (
        "run",
        &[
            ("run", 2),
            ("run --config nosuch.toml", 2),
            ("run --config folder", 2),
            ("run --config no-name.toml", 2),
            ("run --config empty-name.toml", 2),
            ("run --config blank-name.toml", 2),
            ("run --config no-toml.toml", 2),
            ("run --config wrong-type.toml", 2),
            ("run --config negative-station.toml", 2),
            ("run --config large-station.toml", 2),
            ("run --config unknown-build.toml", 2),
            ("run --config unknown-key.toml", 2),
            ("run --config place-nan.toml", 2),
            ("run --config place-far.toml", 2),
            ("run --config place-one.toml", 2),
            ("run --config speed-zero.toml", 2),
            ("run --config speed-nan.toml", 2),
            ("run --config speed-inf.toml", 2),
            ("run --config no-link.toml", 2),
            ("run --config no-port.toml", 2),
            ("run --config two-links.toml", 2),
            ("run --config timers.toml", 2),
            ("run --config negative-timer.toml", 2),
            ("run --config battery.toml", 2),
            ("run --config radius.toml", 2),
            ("run --config crossing.toml", 2),
            ("run --config map-place.toml", 2),
            ("run --config site.toml", 2),
            ("run --config boot-corrupt.toml", 2),
            ("run --config boot-nowhere.toml", 2),
            ("run --config robot.toml --site nosuch.toml", 2),
            ("run --config robot.toml --plan nosuch", 2),
            ("run --config robot.toml --plan too-close.toml", 2),
            ("run --config robot.toml --loss 2", 2),
            ("run --config robot.toml --loss -1", 2),
            ("run --config robot.toml --seed -1", 2),
            ("run --config robot.toml --faults loss=2", 2),
            ("run --config robot.toml --multicast 239.1.1.1:47400", 2),
            (
                "run --config robot.toml --multicast group --interface lo",
                2,
            ),
            ("run --config robot.toml --metrics nosuch", 2),
            ("run --config robot.toml --metrics 70000", 2),
            ("run --config robot.toml --status sometimes", 2),
            ("run --config robot.toml --log nosuch/log.jsonl", 2),
            ("run --config robot.toml --pcap nosuch/run.pcap", 2),
            ("run --config robot.toml --perceived nosuch.jsonl", 2),
            ("run --config robot.toml --security enforce", 2),
            ("run --config robot.toml --security enforce --pki folder", 2),
            ("run --config revoked.toml", 2),
            ("run --config trust.toml", 2),
        ],
    ),
    (
        "bounds",
        &[
            ("bounds --config nosuch.toml", 2),
            ("bounds --config text.toml", 2),
            ("bounds --delay -1", 2),
            ("bounds --delay 60001", 2),
            ("bounds --delay soon", 2),
        ],
    ),
    (
        "odds",
        &[
            ("odds --followers 0", 2),
            ("odds --followers 4", 2),
            ("odds --loss 1", 2),
            ("odds --loss 0.5..0.1", 2),
            ("odds --loss some", 2),
            ("odds --delay 0", 2),
            ("odds --delay 60000", 2),
            ("odds --tick 30", 2),
            ("odds --tick 100 --delay 100", 2),
            ("odds --burst 10", 2),
            ("odds --burst 50 --loss 0.6", 2),
            ("odds --hold 60001", 2),
            ("odds --width 1", 2),
            ("odds --config nosuch.toml", 2),
            ("odds --config timers.toml", 2),
            ("odds --vary t_help=1", 2),
            ("odds --vary ram_period=700", 2),
            ("odds --vary n_ack=0", 2),
            ("odds --target complete", 2),
            ("odds --target complete>=2", 2),
            ("odds --target crossing>=0.9within2s", 2),
            ("odds --export out", 2),
            ("odds --csv nosuch/odds.csv", 2),
            ("odds --plot folder", 2),
        ],
    ),
    (
        "check",
        &[
            ("check nosuch", 2),
            ("check folder", 2),
            ("check text.toml", 2),
            ("check no-robots.toml", 2),
            ("check no-property.toml", 2),
            ("check pair nosuch", 2),
            ("check pair --all", 2),
            ("check pair --large", 2),
            ("check --large --threads 2", 2),
            ("check --threads 0", 2),
            ("check --threads -1", 2),
            ("check --max-states 0", 2),
            ("check --timeout -1", 2),
            ("check --timeout 1.5", 2),
            ("check pair --export dot", 2),
            ("check pair --export svg --output graph.svg", 2),
            ("check pair trio --export dot --output graph.dot", 2),
            ("check pair --export dot --output nosuch/graph.dot", 2),
            ("check timed-pair --export dot --output graph.dot", 2),
            ("check pair --charts text.toml", 2),
            ("check pair --junit nosuch/junit.xml", 2),
            ("check --replay nosuch.json", 2),
            ("check --replay text.json", 2),
            ("check --endpoints", 2),
        ],
    ),
    (
        "explore",
        &[
            ("explore", 2),
            ("explore nosuch", 2),
            ("explore timed-pair", 2),
            ("explore pair --address nosuch", 2),
        ],
    ),
    (
        "fuzz",
        &[
            ("fuzz --seeds 0", 2),
            ("fuzz --seeds -1", 2),
            ("fuzz --robots 1", 2),
            ("fuzz --robots 33", 2),
            ("fuzz --seed -1", 2),
            ("fuzz --threads 0", 2),
            ("fuzz --failures 0", 2),
            ("fuzz --faults burst", 2),
            ("fuzz --plan nosuch.toml", 2),
            ("fuzz --site text.toml", 2),
            ("fuzz --plan trio --robots 2", 2),
            ("fuzz --out text.toml", 2),
            ("fuzz --out text.toml/folder", 2),
            ("fuzz --junit nosuch/junit.xml", 2),
        ],
    ),
    (
        "conform",
        &[
            ("conform", 2),
            ("conform --config nosuch.toml", 2),
            ("conform --config folder", 2),
            ("conform --config timers.toml", 2),
            ("conform --config robot.toml", 2),
            ("conform --config robot.toml --rule R0", 2),
            ("conform --list --rule R27", 2),
            ("conform --list --slack 0", 2),
            ("conform --list --slack -1", 2),
            ("conform --list --tester 0", 2),
            ("conform --config robot.toml --typed", 2),
            ("conform --config robot.toml --ask --unattended", 2),
            (
                "conform --address nowhere --peer 127.0.0.1:1 --station 2",
                2,
            ),
            ("conform --address 127.0.0.1:0", 2),
            ("conform --address 127.0.0.1:0 --peer 127.0.0.1:1", 2),
            (
                "conform --address 127.0.0.1:0 --peer 127.0.0.1:1 --station -1",
                2,
            ),
            (
                "conform --address 127.0.0.1:0 --peer 127.0.0.1:1 --station 9001",
                2,
            ),
            (
                "conform --address 192.0.2.1:7 --peer 192.0.2.2:7 --station 2",
                2,
            ),
            (
                "conform --address 127.0.0.1:0 --peer 127.0.0.1:1 --station 2 --junit nosuch/junit.xml",
                2,
            ),
            (
                "conform --address 127.0.0.1:0 --peer 127.0.0.1:1 --station 2 --security sign --pki nosuch",
                2,
            ),
        ],
    ),
    (
        "validate",
        &[
            ("validate", 2),
            ("validate nosuch.jsonl", 2),
            ("validate folder", 2),
            ("validate empty.jsonl", 2),
            ("validate text.jsonl", 2),
            ("validate other.jsonl", 2),
            ("validate text.jsonl --junit nosuch/junit.xml", 2),
        ],
    ),
    (
        "report",
        &[
            ("report", 2),
            ("report nosuch.jsonl", 2),
            ("report text.jsonl --output page.html", 2),
            ("report other.jsonl --output nosuch/page.html", 2),
            ("report other.jsonl --speed 0", 2),
            ("report other.jsonl --speed -3", 2),
        ],
    ),
    (
        "timing",
        &[
            ("timing", 2),
            ("timing nosuch.jsonl", 2),
            ("timing text.jsonl", 2),
            ("timing other.jsonl --speed 101", 2),
            ("timing other.jsonl --speed nan", 2),
        ],
    ),
    (
        "export",
        &[
            ("export", 2),
            ("export other.jsonl", 2),
            ("export nosuch.jsonl --svg chart.svg", 2),
            ("export text.jsonl --svg chart.svg", 2),
            ("export other.jsonl --mcap nosuch/run.mcap", 2),
            ("export other.jsonl --svg folder", 2),
            ("export other.jsonl --mermaid nosuch/chart.mmd", 2),
        ],
    ),
    ("fsm", &[("fsm --format svg", 2), ("fsm more", 2)]),
    (
        "simulate",
        &[
            ("simulate --place random", 2),
            ("simulate obs --robots -1", 2),
            ("simulate obs --robots 1,x", 2),
            ("simulate obs --robots 1000", 2),
            ("simulate obs --pedestrians 0", 2),
            ("simulate obs --pedestrians 21", 2),
            ("simulate obs --radius -1", 2),
            ("simulate obs --radius nan", 2),
            ("simulate obs --radius 101", 2),
            ("simulate obs --seeds 0", 2),
            ("simulate obs --per-intersection 5", 2),
            ("simulate obs --patrol -1", 2),
            ("simulate obs --preset nosuch", 2),
            ("simulate obs --site nosuch", 2),
            ("simulate obs --threads 0", 2),
            ("simulate obs --traces nosuch.json.gz", 2),
            ("simulate obs --traces text.json", 2),
            ("simulate obs --vehicles 3", 2),
            ("simulate obs --csv nosuch/obs.csv", 2),
            ("simulate obs --svg text.toml", 2),
            ("simulate cbr --vam 11", 2),
            ("simulate cbr --vam -1", 2),
            ("simulate cbr --vam nan", 2),
            ("simulate cbr --ram 0.5", 2),
            ("simulate cbr --cam often", 2),
            ("simulate cbr --cam-path-points 41", 2),
            ("simulate cbr --unseen 1.5", 2),
            ("simulate cbr --v2x-share -0.1", 2),
            ("simulate cbr --path-loss-exponent 0", 2),
            ("simulate cbr --vehicles-leave -1", 2),
            ("simulate cbr --suppression never", 2),
            ("simulate cbr --silences nosuch/silences.csv", 2),
            ("simulate record", 2),
            ("simulate record --sumo folder --duration 5", 2),
            ("simulate record --sumo folder --grid-size 1", 2),
            ("simulate record --sumo folder --seeds 0", 2),
        ],
    ),
    (
        "studio",
        &[
            ("studio --site street", 2),
            ("studio nosuch.jsonl", 2),
            ("studio folder", 2),
            ("studio text.jsonl", 2),
            ("studio other.jsonl --site nosuch.toml", 2),
            ("studio other.jsonl --port 65536", 2),
            ("studio other.jsonl --address nosuch", 2),
            ("studio --follow", 2),
            ("studio --follow nosuch/log.jsonl", 2),
            ("studio --replay nosuch.json", 2),
            ("studio --replay text.json", 2),
            ("studio --numbers nosuch.json", 2),
            ("studio --numbers text.json", 2),
        ],
    ),
    (
        "sniff",
        &[
            ("sniff", 2),
            ("sniff nosuch.pcap", 2),
            ("sniff folder", 2),
            ("sniff text.pcap", 2),
            ("sniff text.pcap --count -1", 2),
            ("sniff text.pcap --seconds nan", 2),
            ("sniff text.pcap --seconds -1", 2),
            ("sniff --address nosuch", 2),
            ("sniff --multicast 239.1.1.1:47400", 2),
            ("sniff text.pcap --pcap copy.pcap", 2),
            ("sniff --address 127.0.0.1:0 --pcap nosuch/heard.pcap", 2),
            ("sniff text.pcap --dictionary 3.0", 2),
            ("sniff text.pcap --config nosuch.toml", 2),
            ("sniff text.pcap --trust nosuch", 2),
        ],
    ),
    ("router", &[("router --listen", 2), ("router --nosuch", 2)]),
    (
        "site",
        &[
            ("site", 2),
            ("site check --site nosuch.toml", 2),
            ("site check --site folder", 2),
            ("site check --site text.toml", 2),
            ("site check --plan nosuch", 2),
            ("site check --plan nosuch.toml", 2),
            ("site check --plan text.toml", 2),
            ("site check --plan unknown-place.toml", 2),
            ("site check --plan too-close.toml", 2),
            ("site draw --plan unknown-task.toml", 2),
            ("site draw --svg nosuch/site.svg", 2),
        ],
    ),
    (
        "codec",
        &[
            ("codec", 2),
            ("codec decode nosuch.bin", 2),
            ("codec decode folder", 2),
            ("codec decode text.json", 2),
            ("codec decode text.json --binary", 2),
            ("codec decode --hex 0", 2),
            ("codec decode --hex xyz", 2),
            ("codec decode --hex 01", 2),
            ("codec decode", 2),
            ("codec encode nosuch.json", 2),
            ("codec encode text.json", 2),
            ("codec encode", 2),
        ],
    ),
    (
        "pki",
        &[
            ("pki", 2),
            ("pki init", 2),
            ("pki init text.toml", 2),
            ("pki init new --robot ''", 2),
            ("pki init new --robot a/b", 2),
            ("pki init new --count 0", 2),
            ("pki init new --count -1", 2),
            ("pki init new --hours 0", 2),
            ("pki init new --start-in 87601", 2),
            ("pki init new --start-in soon", 2),
            ("pki init new --start-in 87600", 2),
            ("pki init new --part nosuch", 2),
            ("pki init new --its-aid RAM", 2),
            ("pki init new --its-aid 36:zz", 2),
            ("pki init new --circle 91,0,5", 2),
            ("pki init new --circle nan,0,5", 2),
            ("pki init new --circle 48,9", 2),
            ("pki init new --rectangle 48,9,49,10", 2),
            ("pki root new --years 0", 2),
            ("pki root new --name ''", 2),
            ("pki authority nosuch", 2),
            ("pki tickets nosuch --robot ARI", 2),
            ("pki tickets folder", 2),
            ("pki init new --robot ARI=first", 2),
            ("pki revoke folder", 2),
            ("pki revoke folder --robot a/b", 2),
            ("pki revoke folder --robot nosuch", 2),
            ("pki revoke folder --certificate text.cert", 2),
            ("pki show nosuch.cert", 2),
            ("pki show text.cert", 2),
        ],
    ),
];
