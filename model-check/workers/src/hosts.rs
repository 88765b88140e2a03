//! The file that says where the processes of a check listen.

/// Where each process listens, in the order of their numbers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Hosts(Vec<String>);

/// Fault of a file of hosts, or of the number of a process.
#[derive(Debug, thiserror::Error)]
pub enum HostsError {
    /// A line is no address.
    #[error(
        "line {line} of the hosts is '{text}'; each line is one HOST:PORT, such as 10.0.0.1:7000"
    )]
    NoAddress {
        /// The line, counted from 1.
        line: usize,
        /// Its text.
        text: String,
    },
    /// Two processes would listen at the same address.
    #[error(
        "line {line} of the hosts says '{address}' again; each process needs an address of its own"
    )]
    Twice {
        /// The line, counted from 1.
        line: usize,
        /// The address.
        address: String,
    },
    /// There is no second process.
    #[error("{count} of at least 2 hosts; for one process leave --hosts out and use --workers")]
    TooFew {
        /// How many lines there are.
        count: usize,
    },
    /// There is no process of this number.
    #[error("there is no process {process}: the hosts are of processes 0 to {last}")]
    NoSuchProcess {
        /// The number asked for.
        process: usize,
        /// The highest one.
        last: usize,
    },
}

impl Hosts {
    /// The hosts of a text: one `HOST:PORT` a line; empty lines and lines that begin with `#` say nothing.
    ///
    /// # Errors
    /// It does not name two different addresses at least.
    pub fn parse(text: &str) -> Result<Self, HostsError> {
        let mut hosts: Vec<String> = Vec::new();
        let lines = text.lines().map(str::trim).zip(1..);
        for (address, line) in lines.filter(|(text, _)| !text.is_empty() && !text.starts_with('#'))
        {
            if !is_address(address) {
                let text = address.to_owned();
                return Err(HostsError::NoAddress { line, text });
            }
            if hosts.iter().any(|known| known == address) {
                let address = address.to_owned();
                return Err(HostsError::Twice { line, address });
            }
            hosts.push(address.to_owned());
        }
        match hosts.len() {
            count @ (0 | 1) => Err(HostsError::TooFew { count }),
            _ => Ok(Self(hosts)),
        }
    }

    /// The process of this number among them.
    ///
    /// # Errors
    /// There is none.
    pub fn process(self, process: usize) -> Result<Cluster, HostsError> {
        let last = self.0.len() - 1;
        if process > last {
            return Err(HostsError::NoSuchProcess { process, last });
        }
        Ok(Cluster {
            addresses: self.0,
            process,
        })
    }
}

fn is_address(text: &str) -> bool {
    let port = text.rsplit_once(':').filter(|(host, _)| !host.is_empty());
    let port = port.and_then(|(_, port)| port.parse::<u16>().ok());
    port.is_some_and(|port| port != 0) && !text.contains(char::is_whitespace)
}

/// One process among those of a check.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Cluster {
    pub(crate) addresses: Vec<String>,
    pub(crate) process: usize,
}

impl Cluster {
    /// How many processes there are.
    #[must_use]
    pub const fn processes(&self) -> usize {
        self.addresses.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_hosts_is_read_line_by_line() {
        let hosts = Hosts::parse("# two\n\n127.0.0.1:7000\n [::1]:7001 \n").unwrap();
        assert_eq!(hosts.0, ["127.0.0.1:7000", "[::1]:7001"]);
        assert_eq!(hosts.clone().process(1).unwrap().processes(), 2);
        let refused = hosts.process(2).unwrap_err().to_string();
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
            let refused = Hosts::parse(text).unwrap_err().to_string();
            assert!(refused.starts_with(cause), "{refused}");
        }
    }
}
