"""The CURVE keys of a participant: `participant.key` and `orchestrator.pub`, as `grainstep-keys DIR` makes them."""

import pathlib

import zmq
from zmq.utils import z85

from grainstep.errors import InputError

SIZE = 40  # Z85 characters


def read_key(file):
    """A key of `file`, bytes of Z85 text. InputError where it is none."""
    try:
        words = file.read_text().split()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: cannot be read ({error}); `grainstep-keys DIR` makes keys") from error
    try:
        text = words[0].encode("ascii")
        if len(text) == SIZE and len(z85.decode(text)) == 32:
            return text
    except (IndexError, ValueError, KeyError, UnicodeEncodeError):
        pass
    raise InputError(f"{file}: is not a CURVE key of {SIZE} Z85 characters")


def use_keys(socket, directory):
    """Shows the participant's own pair on `socket` and expects the orchestrator's."""
    secret = pathlib.Path(directory) / "participant.key"
    if secret.exists() and secret.stat().st_mode & 0o077:
        raise InputError(f"{secret}: others than its owner may read this secret key; run `chmod 600` on it")
    own = read_key(secret)
    socket.curve_serverkey = read_key(secret.with_name("orchestrator.pub"))
    socket.curve_publickey = zmq.curve_public(own)
    socket.curve_secretkey = own
