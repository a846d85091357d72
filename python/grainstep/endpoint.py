"""Where the orchestrator listens: tcp://HOST:PORT, or ipc:///PATH on this host. Checked before a socket is made."""

import re

from grainstep.errors import InputError

HOST = re.compile(r"\[[0-9A-Za-z:.%]+\]|[0-9A-Za-z._-]+")
FORMS = "expected ipc:///PATH or tcp://HOST:PORT, as the orchestrator prints it"


def check_endpoint(endpoint):
    """InputError unless `endpoint` is one that a participant can connect to."""
    if endpoint.startswith("ipc:///"):
        return
    if endpoint.startswith("tcp://"):
        host, _, port = endpoint[len("tcp://"):].rpartition(":")
        if HOST.fullmatch(host) and re.fullmatch(r"[0-9]{1,5}", port) and 0 < int(port) <= 65535:
            return
        raise InputError(f"--connect {endpoint}: no host and port that one could connect to; {FORMS}")
    hint = ""
    if endpoint.startswith("/"):
        hint = f"did you mean ipc://{endpoint}? "
    elif re.fullmatch(r"[0-9A-Za-z._-]+:[0-9]+", endpoint):
        hint = f"did you mean tcp://{endpoint}? "
    raise InputError(f"--connect {endpoint}: not an endpoint; {hint}{FORMS}")


def leaves_this_host(endpoint):
    """Whether messages to `endpoint` pass a network. A name may begin with 127. too: only a number is the loopback."""
    if not endpoint.startswith("tcp://"):
        return False
    host = endpoint[len("tcp://"):].rpartition(":")[0]
    return not (re.fullmatch(r"127\.[0-9.]+", host) or host in ("localhost", "[::1]"))
