//! Processes of a check, as threads of the test: each has a model of its own, and they speak over TCP.

use std::num::NonZeroUsize;
use std::thread;
use std::time::Duration;

use crossguard_model_check::model::Model;
use crossguard_testkit::ports::free_ports;
use crossguard_workers::{Cluster, Options, WorkersError, WorkersReport, check};

/// Options for this number of workers.
pub(crate) fn workers(number: usize) -> Options {
    Options {
        workers: NonZeroUsize::new(number).unwrap(),
        patience: Duration::from_mins(5),
        ..Options::default()
    }
}

/// Hosts on this machine that are free just now.
pub(crate) fn hosts(number: usize) -> String {
    let ports = u16::try_from(number).unwrap();
    let first = free_ports(ports);
    let lines = (first..first + ports).map(|port| format!("127.0.0.1:{port}"));
    lines.collect::<Vec<_>>().join("\n")
}

/// Reports of some processes, with this number of workers each.
pub(crate) fn by_processes(
    model: &(dyn Fn() -> Model + Sync),
    processes: usize,
    number: usize,
) -> Vec<Result<WorkersReport, WorkersError>> {
    let hosts = hosts(processes);
    thread::scope(|scope| {
        let running: Vec<_> = (0..processes)
            .map(|process| {
                let options = Options {
                    cluster: Some(Cluster::parse(&hosts, process).unwrap()),
                    ..workers(number)
                };
                scope.spawn(move || check(&model(), &options, &mut |_| ()))
            })
            .collect();
        running.into_iter().map(|one| one.join().unwrap()).collect()
    })
}
