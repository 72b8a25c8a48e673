"""The version of this package; tests/cli/python.sh compares it with that of the library (lib/base/version.h)."""

__version__ = "0.3.0"
