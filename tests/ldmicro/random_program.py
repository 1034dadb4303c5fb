# SPDX-License-Identifier: MIT
"""A random program of LDmicro: circuits in one another, with all elements that have an equivalent here."""


class Maker:
    def __init__(self, random):
        self.random = random
        self.old = random.random() < 0.5
        self.cycle = random.choice([10000, 5000, 1000, 2500])
        self.jumps = random.random() < 0.3
        self.master = random.random() < 0.3
        self.size = {}
        self.timers = {}
        if not self.old and random.random() < 0.6:
            self.size = {name: random.choice([1, 2, 4]) for name in ('a', 'b', 'c', 's0', 's1', 's2', 's3')}
        self.subs = ['Sub1', 'Sub2'] if random.random() < 0.2 else []

    def pick(self, *options):
        return self.random.choice(options)

    def bit(self, write=False):
        names = ['Y0', 'Y1', 'Y2', 'R0', 'R1', 'R2', 'R3']
        return self.random.choice(names if write else names + ['X0', 'X1', 'X2', 'X3'] * 2)

    def variable(self):
        return self.pick('a', 'b', 'c')

    def literal(self):
        r = self.random
        return r.choice([str(r.randint(-9, 9)), str(r.randint(-40000, 40000)), str(r.randint(0, 300)),
                         hex(r.randint(0, 0xffff)), bin(r.randint(0, 255)), "'a'", '0', '1'])

    def value(self):
        return self.literal() if self.random.random() < 0.4 else self.pick('a', 'b', 'c', 'C0', 's1')

    def delay(self):
        return str(self.random.randint(2, 6) * self.cycle + self.pick(0, 0, self.cycle // 2))

    def timer(self):
        kind = self.pick('TON', 'TOF', 'RTO', 'RTL', 'TCY', 'THI', 'TLO')
        name = f'T{kind}{self.random.randint(0, 1)}'
        if self.old and kind not in ('TON', 'TOF', 'RTO'):
            return f'TON TTON{self.random.randint(0, 1)} {self.delay()}'
        if kind in ('TON', 'TOF', 'TCY', 'THI', 'TLO') and self.random.random() < 0.15:
            return f'{kind} {name} C0'
        adjust = f' {self.pick(-1, 0, 1)}' if self.random.random() < 0.2 else ''
        return f'{kind} {name} {self.delay()}{adjust}'

    def counter(self):
        kind = self.pick('CTU', 'CTD', 'CTC', 'CTR')
        name = f'C{self.random.randint(0, 2)}'
        low = self.random.randint(-3, 2)
        high = self.random.randint(3, 6)
        end, start = (high, low) if kind in ('CTU', 'CTC') else (low, high)
        if self.random.random() < 0.3:
            return f'{kind} {name} {end}' if kind in ('CTU', 'CTC') else f'{kind} {name} {low}'
        kinds = f' {self.pick("/", chr(92), "-", "o")}' if self.random.random() < 0.4 else ''
        first = 'C3' if self.random.random() < 0.15 else str(start)
        return f'{kind} {name} {end} {first}{kinds}'

    def test(self):
        kind = self.random.random()
        if kind < 0.5:
            return f'CONTACTS {self.bit()} {self.pick(0, 1)}'
        if kind < 0.65:
            return f'{self.pick("EQU", "NEQ", "GRT", "GEQ", "LES", "LEQ")} {self.value()} {self.value()}'
        if kind < 0.72:
            return f'{self.pick("IF_BIT_SET", "IF_BIT_CLEAR")} {self.variable()} {self.random.randint(0, 7)}'
        if kind < 0.8:
            return self.pick('OSR', 'OSF', 'OSC', 'ODR', 'ODF')
        if kind < 0.9:
            return self.timer()
        if kind < 0.96:
            return self.counter()
        return self.pick('SHORT', 'SHORT', 'OPEN')

    def math(self):
        r = self.random
        name = self.variable()
        kind = r.randint(0, 9)
        if kind == 0:
            return f'MOVE {self.pick(name, "C0", "TRTO0")} {self.value()}'
        if kind == 1:
            return f'{self.pick("NEG", "NOT", "SWAP", "MOVE")} {name} {self.variable()}'
        if kind == 2:
            return f'{self.pick("SHL", "SHR", "SR0", "ROL", "ROR")} {name} {self.variable()} {r.randint(0, 7)}'
        if kind == 3:
            return f'{self.pick("AND", "OR", "XOR")} {name} {self.value()} {self.value()}'
        if kind == 4:
            return f'{self.pick("SET_BIT", "CLEAR_BIT")} {name} {r.randint(0, 7)}'
        if kind == 5:
            return f'{self.pick("DIV", "MOD")} {name} {self.value()} {self.pick("3", "-7", "b", "10")}'
        return f'{self.pick("ADD", "SUB", "MUL")} {name} {self.value()} {self.value()}'

    def act(self):
        r = self.random
        kind = r.random()
        if kind < 0.45:
            shape = self.pick('0 0 0', '0 0 0', '1 0 0', '0 1 0', '0 0 1', '0 0 0 1')
            return f'COIL {self.bit(True)} {shape}'
        if kind < 0.75:
            return self.math()
        if kind < 0.8:
            return f'RES {self.pick("C0", "C1", "TRTO0", "TRTL1", "TTON0")}'
        if kind < 0.84:
            return f'SHIFT_REGISTER s {self.random.randint(2, 4)}'
        if kind < 0.88:
            values = [str(r.randint(-99, 99)) for _ in range(r.randint(1, 6))]
            return f'LOOK_UP_TABLE {self.variable()} {self.pick("C0", "a")} {len(values)} 0 {" ".join(values)}'
        if kind < 0.92:
            points, x = [], r.randint(-20, 0)
            for _ in range(r.randint(1, 4)):
                points += [str(x), str(r.randint(-90, 90))]
                x += r.randint(1, 60)
            return f'PIECEWISE_LINEAR {self.variable()} {self.variable()} {len(points) // 2} {" ".join(points)}'
        if kind < 0.94:
            return 'READ_ADC Ain'
        if kind < 0.96:
            return f'SET_PWM {self.variable()} 1000 Pout'
        if kind < 0.97:
            return f'TIME2COUNT {self.variable()} {self.delay()}'
        return f'PERSIST {self.variable()}'

    def circuit(self, depth, end):
        """Lines of a series; @end: it may act."""
        lines = []
        for _ in range(self.random.randint(1, 3)):
            if depth < 3 and self.random.random() < 0.3:
                lines += self.parallel(depth + 1, False)
            else:
                lines.append(self.test() if self.random.random() < 0.85 else self.act())
        if not end:
            return lines
        if depth < 3 and self.random.random() < 0.4:
            return lines + self.parallel(depth + 1, True)
        return lines + [self.act()]

    def parallel(self, depth, end):
        lines = ['PARALLEL']
        for _ in range(self.random.randint(2, 3)):
            branch = self.circuit(depth, end)
            if len(branch) > 1:
                branch = ['SERIES'] + branch + ['END']
            lines += branch
        return lines + ['END']

    def rung(self):
        kind = self.random.random()
        if kind < 0.04:
            return ['COMMENT A rung that says \\r\\nsomething']
        if kind < 0.06:
            return []
        if self.master and kind < 0.2:
            return self.circuit(2, False) + ['MASTER_RELAY']
        return self.circuit(0, True)

    def text(self):
        rungs = [self.rung() for _ in range(self.random.randint(2, 9))]
        if self.jumps:
            for at in sorted(self.random.sample(range(len(rungs)), 1)):
                rungs[at] = self.circuit(2, False) + [f'GOTO {"End" if self.subs else self.pick("End", str(len(rungs) + 1))}'] + \
                    ([self.act()] if self.random.random() < 0.5 else [])
            rungs.append(['LABEL End', 'COIL Y3 0 0 0'])
            rungs.append(self.rung())
        for sub in self.subs:
            rungs.insert(self.random.randint(0, max(0, len(rungs) - 2 * self.jumps)), self.circuit(2, False) + [f'GOSUB {sub}'])
        for sub in self.subs:
            rungs += [[f'SUBPROG {sub}']] + [self.circuit(1, True) for _ in range(2)]
            if self.random.random() < 0.5:
                rungs += [self.circuit(2, False) + ['RETURN'], self.circuit(1, True)]
            rungs += [[f'ENDSUB {sub}']]
        lines = ['LDmicro0.1' if self.old else 'LDmicro0.2', f'CYCLE={self.cycle} us at Timer1', 'CRYSTAL=4000000']
        if self.size:
            lines += ['VAR LIST'] + [f'  {size} bytes {name}' for name, size in self.size.items()] + ['END']
        lines += ['IO LIST'] + [f'  {name} at {i + 1}' for i, name in enumerate(
            ('X0', 'X1', 'X2', 'X3', 'Y0', 'Y1', 'Y2', 'Y3', 'Ain', 'Pout'))] + ['END', 'PROGRAM']
        for rung in rungs:
            lines += ['RUNG'] + rung + ['END']
        return '\n'.join(lines) + '\n'
