//! The file that says where the processes of a check listen.

/// One process among those of a check.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Cluster {
    /// Where each process listens, in the order of their numbers.
    pub(crate) addresses: Vec<String>,
    pub(crate) process: usize,
}

/// Fault of a file of hosts, or of the number of a process, in words.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct HostsError(String);

impl Cluster {
    /// The process of this number among the hosts of a text: one `HOST:PORT` a line; empty lines and lines that begin with `#` say
    /// nothing.
    ///
    /// # Errors
    /// The text does not name two different addresses at least, or has no process of this number.
    pub fn parse(text: &str, process: usize) -> Result<Self, HostsError> {
        let wrong = |why| Err(HostsError(why));
        let mut addresses: Vec<String> = Vec::new();
        let lines = text.lines().map(str::trim).zip(1..);
        for (address, line) in lines.filter(|(text, _)| !text.is_empty() && !text.starts_with('#'))
        {
            if !is_address(address) {
                return wrong(format!(
                    "line {line} of the hosts is '{address}'; each line is one HOST:PORT, such as 10.0.0.1:7000"
                ));
            }
            if addresses.iter().any(|known| known == address) {
                return wrong(format!(
                    "line {line} of the hosts says '{address}' again; each process needs an address of its own"
                ));
            }
            addresses.push(address.to_owned());
        }
        match addresses.len() {
            count @ (0 | 1) => wrong(format!(
                "{count} of at least 2 hosts; for one process leave --hosts out and use --workers"
            )),
            count if process >= count => wrong(format!(
                "there is no process {process}: the hosts are of processes 0 to {}",
                count - 1
            )),
            _ => Ok(Self { addresses, process }),
        }
    }

    /// How many processes there are.
    #[must_use]
    pub const fn processes(&self) -> usize {
        self.addresses.len()
    }
}

fn is_address(text: &str) -> bool {
    let port = text.rsplit_once(':').filter(|(host, _)| !host.is_empty());
    let port = port.and_then(|(_, port)| port.parse::<u16>().ok());
    port.is_some_and(|port| port != 0) && !text.contains(char::is_whitespace)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_hosts_is_read_line_by_line() {
        let hosts = "# two\n\n127.0.0.1:7000\n [::1]:7001 \n";
        let cluster = Cluster::parse(hosts, 1).unwrap();
        assert_eq!(cluster.addresses, ["127.0.0.1:7000", "[::1]:7001"]);
        let refused = Cluster::parse(hosts, 2).unwrap_err().to_string();
        assert_eq!(
            refused,
            "there is no process 2: the hosts are of processes 0 to 1"
        );
    }

    #[test]
    fn what_is_no_file_of_hosts_is_refused_with_the_line() {
        for (text, cause) in [
            ("a:1\nb\n", "line 2 of the hosts is 'b'"),
            ("a:1\nb:0\n", "line 2 of the hosts is 'b:0'"),
            ("a:1\nb:99999\n", "line 2"),
            ("a:1 b:2\nc:3", "line 1"),
            ("a:1\n\na:1\n", "line 3 of the hosts says 'a:1' again"),
            ("a:1\n", "1 of at least 2 hosts"),
            ("", "0 of at least 2 hosts"),
        ] {
            let refused = Cluster::parse(text, 0).unwrap_err().to_string();
            assert!(refused.starts_with(cause), "{refused}");
        }
    }
}
