"""What goes wrong, with the texts and exit codes of the program `cnem`."""


class Error(Exception):
    """Whatever cnem raises by itself.

    exit_code: what the program `cnem` would end with.
    messages: the lines of the text, a mistake in each where a case has several.
    """

    exit_code = 1

    @property
    def messages(self):
        return str(self).splitlines()


class InputError(Error, ValueError):
    """Wrong case, geometry or use: says where, what was found and what was expected."""

    exit_code = 2


class DivergedError(Error, ArithmeticError):
    """A run has left the range in which it means anything.

    post_mortem: where, when and likely causes, as in status.json; None where the run never began.
    """

    exit_code = 3
    post_mortem = None


class IoError(Error, OSError):
    """Reading or writing failed, or threads could not be had."""

    exit_code = 4
