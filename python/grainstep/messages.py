"""The compiled messages of the protocol, or a clear word where they are missing.

They are made from proto/grainstep/*.proto when the project is built or installed, never when a program runs.
"""

try:
    from grainstep import scene_pb2 as scene
    from grainstep import wire_pb2 as wire
except ImportError as error:
    missing = getattr(error, "name", None) or ""
    if missing.startswith("google"):
        raise ImportError("grainstep needs the Python package protobuf (Debian: python3-protobuf), which is not "
                          "installed for this Python") from error
    raise ImportError("grainstep: the compiled messages (wire_pb2.py) are not beside this file. Build the project and "
                      "put build/python on PYTHONPATH, or run python/compile-messages once in the source "
                      f"tree. What failed: {error}") from error

__all__ = ["scene", "wire"]
