# SPDX-License-Identifier: MIT
"""Runs a program of LDmicro from the text of its file, as the manual of LDmicro describes its elements.

It knows nothing of rung files and shares no code with the import: a second opinion. One element is
done after the other, from left to right, and the branches of a parallel circuit from top to bottom.
"""


def number(text):
    """The value of a literal; None: it is a name."""
    if text.startswith("'"):
        return ord(text[1])
    sign, digits = (-1, text[1:]) if text.startswith('-') else (1, text)
    if not digits[:1].isdigit():
        return None
    if digits[:2].lower() in ('0x', '0b', '0o'):
        return sign * int(digits[2:], {'x': 16, 'b': 2, 'o': 8}[digits[1].lower()])
    return sign * (int(digits, 8) if len(digits) > 1 and digits[0] == '0' else int(digits))


def wrap(value, size):
    """As a signed number of @size bytes."""
    half = 1 << (8 * size - 1)
    return (value + half) % (2 * half) - half


class Leaf:
    def __init__(self, words):
        self.word, self.arg = words[0], words[1:]
        self.was = self.fell = self.half = self.begun = False


class Jump(Exception):
    """GOTO, to a rung; None: RETURN."""

    def __init__(self, rung):
        super().__init__()
        self.rung = rung


class Program:
    def __init__(self, text):
        lines = [line.strip() for line in text.splitlines()]
        self.old = lines[0] == 'LDmicro0.1'
        self.cycle, self.size, self.rungs = 10000, {}, []
        self.bit, self.value, self.input = {}, {}, {}
        self.master = True
        at = 1
        while lines[at] != 'PROGRAM':
            if lines[at].startswith('CYCLE='):
                self.cycle = int(lines[at][6:].split()[0])
            words = lines[at].split()
            if len(words) > 2 and words[1] == 'bytes':
                self.size[words[2]] = int(words[0])
            at += 1
        at += 1
        while at < len(lines):
            if lines[at].startswith('RUNG'):
                rung, at = self.circuit(lines, at + 1)
                self.rungs.append(rung)
            else:
                at += 1
        self.leaves = [leaf for rung in self.rungs for leaf in self.all(rung)]
        for leaf in self.leaves:
            if leaf.word == 'TOF' and number(leaf.arg[1]) is not None:
                self.value[leaf.arg[0]] = self.period(leaf)
            if leaf.word in ('CTU', 'CTD', 'CTC', 'CTR'):
                start = number(leaf.arg[2]) if len(leaf.arg) > 2 else 0
                if start is not None:
                    self.value[leaf.arg[0]] = start

    def circuit(self, lines, at):
        found = []
        while lines[at] != 'END':
            if lines[at] in ('SERIES', 'PARALLEL'):
                inner, end = self.circuit(lines, at + 1)
                found.append((lines[at], inner))
                at = end
            else:
                if lines[at]:
                    found.append(Leaf(lines[at].split()))
                at += 1
        return found, at + 1

    def all(self, circuit):
        for node in circuit:
            if isinstance(node, Leaf):
                yield node
            else:
                yield from self.all(node[1])

    # ---- values ----

    def bytes(self, name):
        return self.size.get(name, 2)

    def get(self, text):
        literal = number(text)
        return self.value.get(text, 0) if literal is None else literal

    def put(self, name, value):
        self.value[name] = wrap(value, self.bytes(name))

    def period(self, leaf):
        delay = number(leaf.arg[1])
        if delay is None:
            return self.get(leaf.arg[1])
        adjust = -1 if self.old and leaf.word in ('TON', 'TOF', 'RTO') else 0
        if len(leaf.arg) > 2:
            adjust = int(leaf.arg[2])
        return max(1, (delay + self.cycle * adjust) // self.cycle)

    # ---- a scan ----

    def scan(self):
        self.master = True
        self.run(0, None)

    def run(self, at, sub):
        """From a rung on; a subprogram ends at its ENDSUB."""
        while at < len(self.rungs):
            first = [node for node in self.rungs[at] if isinstance(node, Leaf)]
            words = {leaf.word: leaf for leaf in first}
            if 'SUBPROG' in words:
                at = 1 + next(i for i, rung in enumerate(self.rungs) if any(
                    isinstance(node, Leaf) and node.word == 'ENDSUB' and node.arg == words['SUBPROG'].arg
                    for node in rung))
                continue
            if 'ENDSUB' in words:
                return
            try:
                self.series(self.rungs[at], self.master)
                at += 1
            except Jump as jump:
                if jump.rung is None:
                    return
                at = jump.rung

    def series(self, circuit, power):
        for node in circuit:
            if isinstance(node, Leaf):
                power = self.element(node, power)
            elif node[0] == 'SERIES':
                power = self.series(node[1], power)
            else:
                power = self.parallel(node[1], power)
        return power

    def parallel(self, circuit, power):
        out = False
        for node in circuit:
            if self.series([node], power):
                out = True
        return out

    def element(self, leaf, power):
        done = getattr(self, 'do_' + leaf.word, None) or getattr(self, 'do_' + KIND[leaf.word])
        return done(leaf, power)

    def do_CONTACTS(self, leaf, power):
        return power and self.bit.get(leaf.arg[0], False) != (leaf.arg[1] != '0')

    def do_COIL(self, leaf, power):
        name, (negated, sets, resets) = leaf.arg[0], [flag != '0' for flag in leaf.arg[1:4]]
        if negated:
            self.bit[name] = not power
        elif sets:
            self.bit[name] = self.bit.get(name, False) or power
        elif resets:
            self.bit[name] = self.bit.get(name, False) and not power
        elif len(leaf.arg) > 4 and leaf.arg[4] != '0':
            if power and not leaf.was:
                self.bit[name] = not self.bit.get(name, False)
            leaf.was = power
        else:
            self.bit[name] = power
        return power

    def do_wire(self, _leaf, power):
        return power

    def do_OPEN(self, _leaf, _power):
        return False

    def do_MASTER_RELAY(self, _leaf, power):
        self.master = power if self.master else True
        return power

    # ---- edges ----

    def do_OSR(self, leaf, power):
        out, leaf.was = power and not leaf.was, power
        return out

    def do_OSF(self, leaf, power):
        out, leaf.was = leaf.was and not power, power
        return out

    def do_ODR(self, leaf, power):
        return not self.do_OSR(leaf, power)

    def do_ODF(self, leaf, power):
        if power:
            leaf.was, leaf.fell = True, False
            return True
        out = leaf.fell
        leaf.fell = leaf.fell or leaf.was
        return out

    def do_OSC(self, leaf, power):
        leaf.half = power and not leaf.half
        return leaf.half

    # ---- timers ----

    def count(self, leaf):
        self.put(leaf.arg[0], self.get(leaf.arg[0]) + 1)

    def elapsed(self, leaf):
        return self.get(leaf.arg[0]) >= self.period(leaf)

    def do_TON(self, leaf, power):
        if not power:
            self.put(leaf.arg[0], 0)
            return False
        if self.elapsed(leaf):
            return True
        self.count(leaf)
        return False

    def do_TOF(self, leaf, power):
        if power:
            self.put(leaf.arg[0], 0)
            return True
        if self.elapsed(leaf):
            return False
        self.count(leaf)
        return True

    def do_RTO(self, leaf, power):
        if self.elapsed(leaf):
            return True
        if power:
            self.count(leaf)
        return False

    def do_RTL(self, leaf, power):
        if self.elapsed(leaf):
            return True
        if not power:
            self.count(leaf)
        return False

    def do_TCY(self, leaf, power):
        if not power:
            self.put(leaf.arg[0], 0)
            return False
        if self.elapsed(leaf):
            self.put(leaf.arg[0], 0)
            leaf.half = not leaf.half
        else:
            self.count(leaf)
        return leaf.half

    def do_THI(self, leaf, power):
        leaf.begun = leaf.begun or power
        if not leaf.begun:
            return False
        if not self.elapsed(leaf):
            self.count(leaf)
            return True
        if not power:
            self.put(leaf.arg[0], 0)
            leaf.begun = False
        return False

    def do_TLO(self, leaf, power):
        if power:
            leaf.was = True
        elif leaf.was:
            leaf.begun = True
        if not leaf.begun:
            return leaf.was
        if not self.elapsed(leaf):
            self.count(leaf)
            return False
        if power:
            self.put(leaf.arg[0], 0)
            leaf.begun = False
        return True

    # ---- counters ----

    def counts(self, leaf, power):
        if len(leaf.arg) > 2 and number(leaf.arg[2]) is None and not leaf.begun:
            self.put(leaf.arg[0], self.get(leaf.arg[2]))
        leaf.begun = True
        kind = leaf.arg[3] if len(leaf.arg) > 3 else '/'
        step = {'/': power and not leaf.was, '\\': leaf.was and not power, '-': power,
                'o': not power}[kind]
        leaf.was = power
        return step

    def do_CTU(self, leaf, power):
        name, most = leaf.arg[0], leaf.arg[1]
        if self.counts(leaf, power) and self.get(name) < self.get(most):
            self.put(name, self.get(name) + 1)
        return self.get(name) >= self.get(most)

    def do_CTD(self, leaf, power):
        name, least = leaf.arg[0], leaf.arg[1]
        if self.counts(leaf, power) and self.get(name) > self.get(least):
            self.put(name, self.get(name) - 1)
        return self.get(name) > self.get(least)

    def circle(self, leaf, power, step):
        name, end = leaf.arg[0], leaf.arg[1]
        if not self.counts(leaf, power):
            return False
        self.put(name, self.get(name) + step)
        if (self.get(name) - self.get(end)) * step <= 0:
            return False
        self.put(name, self.get(leaf.arg[2]) if len(leaf.arg) > 2 else 0)
        return True

    def do_CTC(self, leaf, power):
        return self.circle(leaf, power, 1)

    def do_CTR(self, leaf, power):
        return self.circle(leaf, power, -1)

    def do_RES(self, leaf, power):
        if power:
            start = '0'
            for word in ('CTU', 'CTD', 'CTC', 'CTR'):
                same = [other for other in self.leaves if other.word == word and other.arg[0] == leaf.arg[0]]
                if same and leaf.arg[0].startswith('C'):
                    start = same[0].arg[2] if len(same[0].arg) > 2 else '0'
                    break
            self.put(leaf.arg[0], self.get(start))
        return power

    def do_TIME2COUNT(self, leaf, power):
        if power:
            self.put(leaf.arg[0], self.period(leaf))
        return power

    # ---- numbers ----

    def do_compare(self, leaf, power):
        values = []
        for text, other in (leaf.arg, leaf.arg[::-1]):
            literal = number(text)
            values.append(self.get(text) if literal is None or number(other) is not None
                          else wrap(literal, self.bytes(other)))
        a, b = values
        yes = {'EQU': a == b, 'NEQ': a != b, 'GRT': a > b, 'GEQ': a >= b, 'LES': a < b, 'LEQ': a <= b}
        return power and yes[leaf.word]

    def do_math(self, leaf, power):
        if not power:
            return power
        name = leaf.arg[0]
        size = self.bytes(name)
        args = [wrap(self.get(text), size) for text in leaf.arg[1:3]]
        a, b = args[0], args[-1]
        if leaf.word in ('SHL', 'SHR', 'SR0', 'ROL', 'ROR'):
            b = number(leaf.arg[2])
        bits = 8 * size
        mask = (1 << bits) - 1
        if leaf.word in ('DIV', 'MOD'):
            if b == 0 or (b == -1 and a == -(1 << (bits - 1))):
                return power
            quotient = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
            self.put(name, quotient if leaf.word == 'DIV' else a - quotient * b)
            return power
        value = {
            'MOVE': lambda: a, 'NEG': lambda: -a, 'ADD': lambda: a + b, 'SUB': lambda: a - b,
            'MUL': lambda: a * b, 'AND': lambda: a & b, 'OR': lambda: a | b, 'XOR': lambda: a ^ b,
            'NOT': lambda: ~a, 'SHL': lambda: a << b, 'SHR': lambda: a >> b,
            'SR0': lambda: (a & mask) >> b,
            'ROL': lambda: (a << b) | ((a & mask) >> (bits - b)),
            'ROR': lambda: ((a & mask) >> b) | (a << (bits - b)),
            'SWAP': lambda: int.from_bytes((a & mask).to_bytes(size, 'little'), 'big') if size > 1
            else (a << 4) | ((a & mask) >> 4),
        }[leaf.word]()
        self.put(name, value)
        return power

    def do_bit(self, leaf, power):
        mask, value = 1 << number(leaf.arg[1]), self.get(leaf.arg[0])
        if leaf.word == 'IF_BIT_SET':
            return power and bool(value & mask)
        if leaf.word == 'IF_BIT_CLEAR':
            return power and not value & mask
        if power:
            self.put(leaf.arg[0], value | mask if leaf.word == 'SET_BIT' else value & ~mask)
        return power

    def do_SHIFT_REGISTER(self, leaf, power):
        if power and not leaf.was:
            for i in range(int(leaf.arg[1]) - 1, 0, -1):
                self.put(f'{leaf.arg[0]}{i}', self.get(f'{leaf.arg[0]}{i - 1}'))
        leaf.was = power
        return power

    def do_LOOK_UP_TABLE(self, leaf, power):
        index = self.get(leaf.arg[1])
        if power and 0 <= index < int(leaf.arg[2]):
            self.put(leaf.arg[0], number(leaf.arg[4 + index]))
        return power

    def do_PIECEWISE_LINEAR(self, leaf, power):
        points = [number(text) for text in leaf.arg[3:3 + 2 * int(leaf.arg[2])]]
        name, size = leaf.arg[0], self.bytes(leaf.arg[0])
        if not power:
            return power
        for i in range(int(leaf.arg[2]) - 1, 0, -1):
            x0, y0, x, y = points[2 * i - 2:2 * i + 2]
            if self.get(leaf.arg[1]) > x:
                continue
            out = wrap(wrap(wrap(self.get(leaf.arg[1]), size) - x0, size) * (y - y0), size)
            quotient = abs(out) // (x - x0) * (1 if out >= 0 else -1)
            self.put(name, quotient + y0)
        return power

    def do_READ_ADC(self, leaf, power):
        if power:
            self.put(leaf.arg[0], self.input.get(leaf.arg[0], 0))
        return power

    def do_SET_PWM(self, leaf, power):
        if power:
            self.put(leaf.arg[2], self.get(leaf.arg[0]))
        return power

    # ---- jumps ----

    def label(self, word, name):
        return next(i for i, rung in enumerate(self.rungs) if any(
            isinstance(node, Leaf) and node.word == word and node.arg[0] == name for node in rung))

    def do_GOTO(self, leaf, power):
        if power:
            literal = number(leaf.arg[0])
            raise Jump(self.label('LABEL', leaf.arg[0]) if literal is None else max(literal, 1) - 1)
        return power

    def do_RETURN(self, _leaf, power):
        if power:
            raise Jump(None)
        return power

    def do_GOSUB(self, leaf, power):
        if power:
            self.run(self.label('SUBPROG', leaf.arg[0]) + 1, leaf.arg[0])
        return power


KIND = {word: kind for kind, words in {
    'wire': 'SHORT COMMENT LABEL SUBPROG ENDSUB PERSIST',
    'compare': 'EQU NEQ GRT GEQ LES LEQ',
    'math': 'MOVE NEG ADD SUB MUL DIV MOD AND OR XOR NOT SHL SHR SR0 ROL ROR SWAP',
    'bit': 'IF_BIT_SET IF_BIT_CLEAR SET_BIT CLEAR_BIT',
}.items() for word in words.split()}
