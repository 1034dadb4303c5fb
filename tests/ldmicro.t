#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""ldmicro.t - programs of LDmicro do here what a second evaluator says that they do.

tests/ldmicro/evaluator.py reads the file itself, as LDmicro's manual describes it. With a number as
argument it tries so many random programs.
"""
import os
import random
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, 'ldmicro'))
from evaluator import Program, number  # noqa: E402
from random_program import Maker  # noqa: E402

LADDER = os.path.abspath(os.environ.get('LADDER') or os.path.join(os.environ.get('BUILD') or 'build', 'ladder'))
COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 150
SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 1
tests = 0


def ok(good, name, more=''):
    global tests
    tests += 1
    print(('ok' if good else 'not ok'), tests, '-', name)
    if not good:
        print('\n'.join('# ' + line for line in str(more).splitlines()[:60]))
    return good


def run(*words):
    done = subprocess.run([LADDER, *words], capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout, done.stderr


def spoken(program):
    """Names of bits and numbers whose values can be compared: timers may be blocks here."""
    bits, numbers = set(), {'Ain', 'Pout'}
    for leaf in program.leaves:
        if leaf.word in ('CONTACTS', 'COIL'):
            bits.add(leaf.arg[0])
            continue
        if leaf.word in ('COMMENT', 'LABEL', 'GOTO', 'GOSUB', 'SUBPROG', 'ENDSUB'):
            continue
        if leaf.word == 'SHIFT_REGISTER':
            numbers.update(f's{i}' for i in range(int(leaf.arg[1])))
        numbers.update(text for text in leaf.arg[:3] if re.fullmatch(r'[abc]|C\d|s\d', text))
    return sorted(bits), sorted(numbers)


def compare(text, rng, folder):
    """What differs; '': nothing."""
    program = Program(text)
    path = os.path.join(folder, 'random.ld')
    with open(path, 'w', encoding='utf-8') as out:
        out.write(text)
    bits, numbers = spoken(program)
    has_input = any(leaf.word == 'READ_ADC' for leaf in program.leaves)
    script, expected = ['@print ' + ' '.join(bits + numbers)], []
    inputs = ['X0', 'X1', 'X2', 'X3']
    for scan in range(60):
        acts = []
        for name in inputs:
            if rng.random() < 0.25:
                program.bit[name] = not program.bit.get(name, False)
                acts.append(f'{name}={int(program.bit[name])}')
        if has_input and rng.random() < 0.3:
            program.input['Ain'] = rng.randint(0, 1023)
            acts.append(f'Ain_Input={program.input["Ain"]}')
        script.append(' '.join(acts) or '.')
        program.scan()
        expected.append(' '.join([f'{name}={int(program.bit.get(name, False))}' for name in bits]
                                 + [f'{name}={program.value.get(name, 0)}' for name in numbers]))
    steps = os.path.join(folder, 'script')
    with open(steps, 'w', encoding='utf-8') as out:
        out.write('\n'.join(script) + '\n')
    status, said, wrong = run('trace', path, steps)
    errors = [line for line in wrong.splitlines() if ' error ' in line]
    if status or errors:
        return '\n'.join(errors or [wrong])
    lines = [line.split(' ', 2)[2] for line in said.splitlines()]
    for scan, (is_, want) in enumerate(zip(lines, expected)):
        if is_ != want:
            wrongs = [f'{a} not {b}' for a, b in zip(is_.split(), want.split()) if a != b]
            return f'scan {scan + 1}: {", ".join(wrongs)}'
    return '' if len(lines) == len(expected) else f'{len(lines)} scans'


def differential(folder):
    bad = ''
    cut = elements = 0
    for seed in range(SEED, SEED + COUNT):
        rng = random.Random(seed)
        text = Maker(rng).text()
        bad = compare(text, rng, folder)
        if bad:
            bad = f'seed {seed}: {bad}\n{text}'
            break
        status, said, _ = run('import', os.path.join(folder, 'random.ld'))
        found = re.search(r'taken: rungs: (\d+), elements: (\d+)', said)
        want = len(Program(text).leaves)
        if status or not found or int(found[2]) != want:
            bad = f'seed {seed}: {want} elements, but {said}'
            break
        elements += want
        cut += 'this rung became' in said
    ok(not bad, f'{COUNT} random programs do what LDmicro does', bad)
    ok(bad or cut > COUNT // 20, 'some rungs had to be cut', f'{cut} programs')


def put(folder, lines, name='program.ld', head='LDmicro0.1\nCYCLE=10000'):
    path = os.path.join(folder, name)
    with open(path, 'w', encoding='utf-8') as out:
        out.write(head + '\n\nPROGRAM\n' + '\n'.join(lines) + '\n')
    return path


def report(folder, lines, **more):
    """The lines of the report without the path; and the text."""
    path, out = put(folder, lines, **more), os.path.join(folder, 'out.rung')
    _, said, wrong = run('import', path, '-o', out)
    with open(out, encoding='utf-8') as text:
        return [line[len(path):] for line in said.splitlines()], text.read(), wrong


def everything(folder):
    """One element of each kind: it stands in the text, or a line of the report names it."""
    here = os.path.join(HERE, 'fuzz', 'corpus', 'ldmicro', 'all.ld')
    status, said, wrong = run('import', here, '-o', os.path.join(folder, 'all.rung'))
    ok(status == 0, 'a program with elements that have no equivalent is imported', wrong)
    with open(os.path.join(folder, 'all.rung'), encoding='utf-8') as text:
        rungs = text.read()
    for word in ('SPI spi1', 'UART_RECV got', 'FORMATTED_STRING small', 'STEPPER s', 'RANDOM r', '7SEGMENTS seg'):
        told = [line for line in said.splitlines() if ': lost: ' in line and word in line]
        ok(len(told) == 1 and re.search(r'all\.ld:\d+: lost: Main rung \d+: ', told[0]), f'{word} is told', said)
        ok(f"WHAT:='{word}" in rungs, f'{word} stands in the program', rungs)
    for word in ('CRYSTAL=', 'BAUD=', 'COMPILED=', 'PB: 0xFF', '#PORTB', 'pin 14', 'pin 23'):
        ok(any('lost' in line and word in line for line in said.splitlines()), f'{word} is told', said)
    ok('(* Each element once *)' in rungs and '(* second line *)' in rungs, 'a comment keeps its lines', rungs)
    status, _, wrong = run('check', os.path.join(folder, 'all.rung'))
    ok(status == 0, 'the result is a program', wrong)
    status, said, wrong = run('fmt', '--check', os.path.join(folder, 'all.rung'))
    ok(status == 0 and not said, 'it is written in the canonical form', said + wrong)


def names(folder):
    told, text, _ = report(folder, [
        'RUNG', 'CONTACTS Xa 0', 'CONTACTS XA 0', 'COIL Yif 0 0 0', 'END',
        'RUNG', 'CONTACTS Yif 0', 'MOVE IF 3', 'END', 'RUNG', 'EQU Yif 1', 'COIL R\u00e4 0 0 0', 'END'])
    ok('Xa ' in text and 'XA_2 ' in text and 'IF_ ' in text, 'names are told apart', text)
    ok('Yif_2 ' in text, 'a bit and a number of one name are two', text)
    for name in ('XA', 'IF', 'Yif'):
        ok(any(f'"{name}" is called' in line for line in told), f'{name} has another name, which is told', told)
    _, text, _ = report(folder, ['RUNG', 'GOSUB 2nd', 'END', 'RUNG', 'GOTO 9', 'END', 'RUNG', 'SUBPROG 2nd', 'END',
                                 'RUNG', 'CONTACTS Xa 0', 'COIL Yb 0 0 0', 'END', 'RUNG', 'ENDSUB 2nd', 'END'])
    ok('CALL N2nd |' in text and 'SUBROUTINE N2nd LD' in text, 'a name that begins with a digit gets a letter', text)


def order(folder):
    told, text, _ = report(folder, ['RUNG', 'CONTACTS Xa 0', 'PARALLEL', 'COIL Ya 0 0 0', 'SERIES', 'CONTACTS Ya 1',
                                    'COIL Yb 0 0 0', 'END', 'END', 'END'])
    ok(text.count('RUNG\n') == 3 and any('became 3' in line for line in told), 'a rung is cut, and that is told', text)
    told, text, _ = report(folder, ['RUNG', 'CONTACTS Xa 0', 'PARALLEL', 'COIL Ya 0 0 0', 'COIL Yb 0 0 0', 'END', 'END'])
    ok(text.count('RUNG\n') == 1 and not any('became' in line for line in told), 'another one stays whole', text)


def limits(folder):
    """The limit of a counter may be a variable: a narrower one is widened, a wider one has no place in the cell."""
    for narrow, wide in ((1, 2), (1, 4), (2, 4), (2, 2)):
        path = put(folder, ['RUNG', 'MOVE most 3', 'END', 'RUNG', 'CONTACTS Xa 0', 'CTU Cn most 0 /', 'COIL Ya 0 0 0', 'END'],
                   head=f'LDmicro0.2\nCYCLE=10000\n\nVAR LIST\n  {narrow} bytes most\n  {wide} bytes Cn\nEND')
        steps = os.path.join(folder, 'steps')
        with open(steps, 'w', encoding='utf-8') as out:
            out.write('@print Cn Ya\n' + 'Xa=1\nXa=0\n' * 4)
        status, said, wrong = run('trace', path, steps)
        ok(status == 0 and re.findall(r'Cn=(\d) Ya=(\d)', said)[::2] == [('1', '0'), ('2', '0'), ('3', '1'), ('3', '1')],
           f'{narrow} bytes limit {wide} bytes', said + wrong)


def periods(folder):
    for head, period in (('LDmicro0.1\nCYCLE=2500', '2.5'), ('LDmicro0.1\nCYCLE=0', '10'), ('LDmicro0.2', '10'),
                         ('LDmicro0.1\nCYCLE=50', '0.1'), ('LDmicro\r\nCYCLE=2500', '2.5'), ('LDmicro\nCYCLE=5000', '5')):
        path = put(folder, ['RUNG', 'CONTACTS Xa 0', 'COIL Ya 0 0 0', 'END'], head=head)
        steps = os.path.join(folder, 'steps')
        with open(steps, 'w', encoding='utf-8') as out:
            out.write('.\n')
        _, said, _ = run('trace', path, steps)
        ok(said.startswith(f'1 t={period} '), f'{head[11:]}: a scan takes {period} ms', said)


def large(folder):
    """As many elements as a file can have do not make it slow, nor the stack deep."""
    for what, lines in (
            ('20,000 contacts in series', ['RUNG'] + ['CONTACTS Xa 0'] * 20000 + ['COIL Ya 0 0 0', 'END']),
            ('5,000 branches', ['RUNG', 'PARALLEL'] + ['CONTACTS Xa 0'] * 5000 + ['END', 'COIL Ya 0 0 0', 'END']),
            ('5,000 coils in series', ['RUNG'] + ['COIL Ya 0 0 0', 'CONTACTS Ya 0'] * 5000 + ['END']),
            ('30 circuits in one another', ['RUNG'] + ['PARALLEL', 'CONTACTS Xb 0', 'SERIES', 'CONTACTS Xa 0'] * 30
             + ['COIL Ya 0 0 0'] + ['END'] * 61)):
        path = put(folder, lines)
        status, _, wrong = run('check', path)
        ok(status == 0, what, wrong[-400:])
    path = put(folder, ['RUNG', 'SHIFT_REGISTER r 99999999', 'LOOK_UP_TABLE a b 4000000000 0 1',
                        'PIECEWISE_LINEAR a b -5 1', 'SET_BIT a 99', 'GOTO nowhere', 'MOVE 3 4', 'END'])
    status, said, wrong = run('import', path)
    ok(status == 0 and said.count('it has no equivalent') == 6, 'values that make no sense are told', said + wrong)


def cut(folder):
    """A file that was cut gives an error with its line."""
    with open(os.path.join(HERE, 'fuzz', 'corpus', 'ldmicro', 'all.ld'), encoding='utf-8') as text:
        whole = text.read()
    bad = ''
    for end in range(len('LDmicro0.2'), len(whole) - 5, 17):
        path = os.path.join(folder, 'cut.ld')
        with open(path, 'w', encoding='utf-8') as out:
            out.write(whole[:end])
        status, _, wrong = run('check', path)
        if status == 0 and re.search(r'END\s*$', whole[:end]):
            continue
        if status != 1 or not re.search(r'cut\.ld:\d+: error LD76', wrong):
            bad += f'{end}: {status} {wrong}'
    ok(not bad, 'a file that ends too early is an error', bad)


with tempfile.TemporaryDirectory() as work:
    differential(work)
    everything(work)
    names(work)
    order(work)
    periods(work)
    limits(work)
    large(work)
    cut(work)
print(f'1..{tests}')
