# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts as arrays of bytes: their lines, words and numbers, and pieces of them replaced."""

import warnings

import numpy as np


def numbers(text, dtype=np.float64):
    """The numbers of a text (bytes) up to the first word that is none."""
    with warnings.catch_warnings():
        warnings.simplefilter('ignore', DeprecationWarning)
        try:
            return np.fromstring(text, dtype, sep=' ') if text and not text.isspace() else np.zeros(0, dtype)
        except ValueError:  # from numpy 3 on, words that are not numbers
            return np.zeros(0, dtype)


def word_starts(text):
    """(n,) bool: at the first letters of words; `text` as uint8, in which up to 32 all is space."""
    space = text <= 32
    start = np.empty(len(text), bool)
    if len(text):
        start[0] = ~space[0]
        np.greater(space[:-1], space[1:], out=start[1:])
    return start


def counts_between(at, begins, end):
    """How many of the ascending places `at` lie from each of the ascending `begins` to the next one."""
    if not len(begins):
        return np.zeros(0, np.int64)
    each, rest = divmod(len(at), len(begins))
    if not rest and each:  # the same number everywhere, most of the time
        if (at[::each] >= begins).all() and (at[each - 1:-1:each] < begins[1:]).all():
            return np.full(len(begins), each)
    return np.diff(np.searchsorted(at, np.r_[begins, end]))


def words_of_lines(text, starts):
    """Number of words in each line; `starts` are the lines' first bytes in `text` (uint8)."""
    return counts_between(np.flatnonzero(word_starts(text)), starts, len(text))


def without_comments(text):
    """Spaces in place of # and what follows on its line; `text` (bytes) keeps its length."""
    if b'#' not in text:
        return text
    return b'\n'.join(line if b'#' not in line else line[:line.index(b'#')].ljust(len(line))
                      for line in text.split(b'\n'))


class Lines:
    """The lines of a text: where each begins, has its first word, and ends."""

    def __init__(self, text):
        if b'\n' not in text:
            text = text.replace(b'\r', b'\n')
        text = self._all = np.frombuffer(text if text.endswith(b'\n') else text + b'\n', np.uint8)
        self.end = np.flatnonzero(text == 10)
        self.begin = np.empty_like(self.end)
        self.begin[0], self.begin[1:] = 0, self.end[:-1] + 1
        self.word, letter = self.begin, text[self.begin]
        if ((letter <= 32) & (letter != 10)).any():
            letters = np.flatnonzero(text > 32)
            following = np.searchsorted(letters, self.begin)
            self.word = np.minimum(np.r_[letters, len(text)][following], self.end)
            letter = text[self.word]
        self._letter = letter
        self._of_letter = {}

    def beginning(self, word):
        """Numbers of the lines whose first word it is."""
        first = word[0]
        if first not in self._of_letter:
            self._of_letter[first] = np.flatnonzero(self._letter == first)
        found = self._of_letter[first]
        if len(word) > 1:
            found = found[self.end[found] - self.word[found] >= len(word)]
        for k, letter in enumerate(word[1:]):
            found = found[self._all[self.word[found] + k + 1] == letter]
        return found[self._all[self.word[found] + len(word)] <= 32]

    def text(self, lines, skipped=0):
        """uint8: the lines without comments and their first letters, and where each begins in it."""
        begin, end = self.begin[lines], self.end[lines] + 1
        length = end - begin
        if not len(lines):
            return np.zeros(0, np.uint8), lines
        if lines[-1] - lines[0] + 1 == len(lines):
            text = self._all[begin[0]:end[-1]]
            text = text.copy() if skipped else text
        else:
            first, last = lines[0], lines[-1] + 1
            wanted = np.zeros(last - first, bool)
            wanted[lines - first] = True
            part = slice(self.begin[first], self.end[last - 1] + 1)
            text = self._all[part][np.repeat(wanted, np.diff(np.r_[self.begin[first:last], part.stop]))]
        new = np.cumsum(length) - length
        first = new + self.word[lines] - begin
        for k in range(skipped):
            text[first + k] = 32
        if (text == ord('#')).any():
            text = np.frombuffer(without_comments(text.tobytes()), np.uint8)
        return text, new

    def words(self, line):
        """Of one line, without its comment."""
        return without_comments(self._all[self.begin[line]:self.end[line]].tobytes()).split()

    def rest(self, line, skipped):
        """(bytes) What follows the first letters of a line."""
        return self._all[self.word[line] + skipped:self.end[line]].tobytes().strip()

    def shown(self, line):
        """The line in a message."""
        return self.rest(line, 0)[:60].decode('utf-8', 'replace')


def spliced(text, *edits):
    """`text` (uint8) with other bytes in places of it.

    Each of the edits is (begin, end, lengths, content): in place of text[begin[k]:end[k]] come the next
    lengths[k] bytes of content. All places are disjoint; those of an edit with content ascend.

    Returns: (bytes, moved): moved(p) is where byte p of `text`, which is in no such place, has gone.
    """
    begin, end, lengths = (np.concatenate([edit[k] for edit in edits]).astype(np.int64) for k in range(3))
    source = np.repeat(np.arange(1, len(edits) + 1, dtype=np.uint8), [len(edit[0]) for edit in edits])
    if len(edits) > 1:
        order = np.argsort(begin, kind='stable')
        begin, end, lengths, source = begin[order], end[order], lengths[order], source[order]
    spans, sources = np.empty(2 * len(begin) + 1, np.int64), np.zeros(2 * len(begin) + 1, np.uint8)
    spans[::2], spans[1::2] = np.r_[begin, len(text)] - np.r_[0, end], end - begin
    sources[1::2] = source
    kept = text[np.repeat(sources == 0, spans)]
    spans[1::2] = lengths
    new = np.repeat(sources, spans)
    result = np.empty(len(new), np.uint8)
    for number, content in enumerate([kept, *(edit[3] for edit in edits)]):
        result[new == number] = content
    grown = np.r_[0, np.cumsum(lengths - (end - begin))]
    return result.tobytes(), lambda p: int(p + grown[np.searchsorted(begin, p, 'left')])


def digits(values, lead=b''):
    """(rows, mask) of bytes, each row `lead` and the decimal digits of a whole number >= 0."""
    width = len(str(int(values.max()))) if len(values) else 1
    rows = np.empty((len(values), len(lead) + width), np.uint8)
    rows[:, :len(lead)] = np.frombuffer(lead, np.uint8)
    mask = np.ones(rows.shape, bool)
    rest = values.astype(np.int64)
    for k in range(width):
        rows[:, -1 - k] = 48 + rest % 10
        if k:
            mask[:, -1 - k] = rest > 0
        rest = rest // 10
    return rows, mask


def table(form, values):
    """Lines of text, each `form` % a row of `values`."""
    return (form * len(values) % tuple(values.ravel().tolist())).encode()


def whole(values, kind=np.int64):
    """Numbers as whole ones of a kind: at its ends what is beyond them, -1 or its largest what is none."""
    values, ends = np.asarray(values), np.iinfo(kind)
    if values.dtype.kind == 'f':
        none = -1 if ends.min < 0 else ends.max
        values = np.where(np.isfinite(values), np.clip(values, ends.min, ends.max - (ends.max >> 53)), none)
    elif values.dtype.itemsize > ends.bits // 8 or values.dtype.kind != np.dtype(kind).kind:
        values = np.clip(values, ends.min, ends.max)
    return values.astype(kind, copy=False)
