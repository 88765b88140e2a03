//! Options about messages of ETSI that robots send beside RAM and RMCM.

use crossguard_endpoint::ras::surroundings::{Awareness, CLUSTER_INTERVAL_MS};

#[derive(clap::Args)]
pub(super) struct EtsiArguments {
    /// Announce clusters of people by ETSI's cluster VAM as well, for devices that do not understand RAM.
    #[arg(long)]
    cluster_vam: bool,
    /// Send ETSI's CAM beside RAM, so that stations which do not understand RAM see the robot.
    #[arg(long)]
    cam: bool,
}

impl EtsiArguments {
    /// Whether any of them is wanted.
    #[cfg(not(feature = "full"))]
    pub(super) const fn are_given(&self) -> bool {
        self.cluster_vam || self.cam
    }

    /// Adds these options to the configured ones.
    pub(super) fn add_to(&self, configured: Awareness) -> Awareness {
        let interval_ms = self.cluster_vam.then_some(CLUSTER_INTERVAL_MS);
        Awareness {
            cluster_vam_interval_ms: interval_ms.or(configured.cluster_vam_interval_ms),
            cam: self.cam || configured.cam,
            ..configured
        }
    }
}
