"""A participant as a program: its options, its exit code, and what it says when it ends badly."""

import argparse
import math
import sys
import traceback

from grainstep import errors
from grainstep.connection import Connection
from grainstep.conversation import Conversation, Stopped
from grainstep.messages import wire


def positive(text):
    """A number above 0 of an option."""
    value = float(text)
    if not (value > 0.0 and math.isfinite(value)):
        raise ValueError
    return value


def parser_of(participant):
    """The options of every participant."""
    parser = argparse.ArgumentParser(description=type(participant).__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--connect", required=True, metavar="ENDPOINT",
                        help="where the orchestrator listens: ipc:///path or tcp://host:port")
    parser.add_argument("--curve-dir", metavar="DIR", help="directory with participant.key and orchestrator.pub")
    parser.add_argument("--connect-deadline", type=positive, default=120.0, metavar="S",
                        help="seconds to wait for the orchestrator's answer (default: 120)")
    parser.add_argument("--allow-plain-tcp", action="store_true", help="unencrypted tcp beyond this host")
    parser.add_argument("--version", action="version", version=participant.version)
    return parser


def main(participant, arguments=None):
    """Takes a Structure or an Impactor (or its class) through a run. Returns the exit code: sys.exit(main(Beam))."""
    if isinstance(participant, type):
        participant = participant()
    options = parser_of(participant).parse_args(arguments)
    try:
        with Connection(options.connect, options.connect_deadline, options.curve_dir,
                        options.allow_plain_tcp) as connection:
            return serve(connection, participant)
    except errors.InputError as error:
        return _say(error, errors.BAD_INPUT)
    except errors.PeerError as error:
        return _say(f"orchestrator: {error}", errors.PEER)
    except KeyboardInterrupt:
        return _say("interrupted", errors.INTERRUPTED)


def serve(connection, participant):
    """The whole conversation; never raises what a participant or its peer did wrong."""
    talk = Conversation(connection, participant.role)
    try:
        try:
            participant.converse(talk)
        except Stopped:
            talk.finish()
        return errors.DONE
    except errors.InputError as error:
        return _end_badly(talk, wire.Error.BAD_INPUT, errors.BAD_INPUT, str(error))
    except errors.NumericalError as error:
        return _end_badly(talk, wire.Error.NUMERICAL, errors.NUMERICAL, str(error))
    except errors.PeerError as error:
        return _end_badly(talk, wire.Error.PROTOCOL, errors.PEER, f"orchestrator: {error}")
    except MemoryError:
        return _end_badly(talk, wire.Error.INTERNAL, errors.PEER, "the system gives no more memory")
    except Exception as error:  # a mistake in the participant: where it is stands in its log
        traceback.print_exc()
        return _end_badly(talk, wire.Error.INTERNAL, errors.PEER,
                          f"{participant.title()}: {type(error).__name__}: {error} ({_place(error)})")


def _place(error):
    """The last line of the participant's own: not of numpy, nor of what else is installed."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if "-packages" not in frame.filename]
    last = (own or frames)[-1]
    return f"{last.filename}, line {last.lineno}, in {last.name}"


def _say(text, code):
    print(f"error: {text}", file=sys.stderr, flush=True)
    return code


def _end_badly(talk, kind, code, text):
    """Tells the orchestrator, if it is still there, and the person at the terminal."""
    _say(text, code)
    try:
        talk.send(error=wire.Error(kind=kind, text=text))
    except errors.PeerError:  # it is lost: that was said above, or is why we are here
        pass
    return code
