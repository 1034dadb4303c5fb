# SPDX-License-Identifier: MIT
"""A client of the link, made from docs/online.md alone: it shares no code with the program."""
import hashlib
import os
import select
import socket
import struct
import termios
import time
import tty

(HELLO, STATUS, SYMBOLS, READ, PUBLISH, UNPUBLISH, WRITE, FORCE, UNFORCE, FORCES, MODE,
 DOWNLOAD, BLOCK, VERIFY, COMMIT, ABORT, UPLOAD, EVENTS, CONFIG, RETAIN, PASSWORD) = range(1, 22)
ALARMS, ACK, CLOCK = 32, 33, 35
RECORD, SUMS, PIECES = 22, 23, 24
IO_BEGIN, IO_MAP, IO_PUT, IO_OUTPUTS, IO_WINDOW, IO_REPORT, DEVICES = range(36, 43)
STOP, RUN, FAULT, ANY = 0, 1, 2, 255
SIZES = [0, 1, 1, 2, 4, 8, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 8, 8, 8, 8, 0]
FORMS = [None, '?', 'B', 'H', 'I', 'Q', 'b', 'h', 'i', 'q', 'B', 'H', 'I', 'Q', 'f', 'd', 'q', 'q', 'q', 'q', None]
BOOL, INT, DINT, TIME, STRING = 1, 7, 8, 16, 20


class Refused(Exception):
    """The board said no: .number and .parts."""

    def __init__(self, number, detail):
        super().__init__(f'{number}: {detail}')
        self.number = number
        self.parts = detail.split('\x1f')


class Gone(Exception):
    """The board has closed the stream."""


class Fields:
    """Takes the fields of a frame, one after another."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, count):
        part = self.data[self.at:self.at + count]
        assert len(part) == count, 'the frame ends too early'
        self.at += count
        return part

    def number(self, form):
        return struct.unpack('<' + form, self.take(struct.calcsize('<' + form)))[0]

    def text(self):
        return self.take(self.number('H')).decode()

    def value(self, kind):
        if kind == STRING:
            return self.take(self.number('B'))
        return self.number(FORMS[kind])

    def rest(self):
        return self.data[self.at:]


def text(string):
    data = string.encode()
    return struct.pack('<H', len(data)) + data


def value(kind, it):
    if kind == STRING:
        return bytes([len(it)]) + it
    return struct.pack('<' + FORMS[kind], it)


def ref(name):
    """A name, or the number of a place."""
    if isinstance(name, int):
        return b'\0' + struct.pack('<I', name)
    return b'\1' + text(name)


def crc32c(data):
    crc = 0xffffffff
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82f63b78 if crc & 1 else 0)
    return crc ^ 0xffffffff


def to_cobs(data):
    out = b''
    parts = data.split(b'\0')
    for part in parts:
        while len(part) >= 254:
            out += b'\xff' + part[:254]
            part = part[254:]
        out += bytes([len(part) + 1]) + part
    return out


def from_cobs(data):
    """None: not COBS."""
    out, at = b'', 0
    while at < len(data):
        run = data[at]
        part = data[at + 1:at + run]
        if len(part) != run - 1:
            return None
        out += part
        at += run
        if run < 255 and at < len(data):
            out += b'\0'
    return out


class Line:
    """A serial line as a stream. `sent_again` counts pieces that were sent again."""

    def __init__(self, path, limit=60, most=512):
        self.fd = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.fd)
        termios.tcflush(self.fd, termios.TCIFLUSH)
        self.session = struct.unpack('<I', os.urandom(4))[0] | 1
        self.sent = self.taken = self.sent_again = 0
        self.limit, self.most = limit, most
        self.data, self.raw, self.begun, self.over = b'', b'', False, False
        self.again(lambda: self.packet(1, 0), lambda: self.begun)

    def packet(self, kind, number, data=b''):
        body = struct.pack('<BIH', kind, self.session, number) + data
        os.write(self.fd, b'\0' + to_cobs(body + struct.pack('<I', crc32c(body))) + b'\0')

    def again(self, send, done):
        until = time.monotonic() + self.limit
        send()
        due = time.monotonic() + 0.2
        while not done():
            if self.over or time.monotonic() > until:
                raise Gone()
            self.hear(max(0, due - time.monotonic()))
            if not done() and time.monotonic() >= due:
                self.sent_again += 1
                send()
                due = time.monotonic() + 0.2

    def hear(self, seconds):
        if select.select([self.fd], [], [], seconds)[0]:
            self.raw += os.read(self.fd, 4096)
        *whole, self.raw = self.raw.split(b'\0')
        for part in whole:
            self.take(from_cobs(part))

    def take(self, packet):
        if not packet or len(packet) < 11 or packet[-4:] != struct.pack('<I', crc32c(packet[:-4])):
            return
        kind, session, number = struct.unpack('<BIH', packet[:7])
        if session != self.session:
            return
        if kind == 129:
            self.begun = True
        elif kind == 130 and self.begun:
            if number == (self.taken + 1) % 65536:
                self.taken = number
                self.data += packet[7:-4]
            if number == self.taken:
                self.packet(3, number)
        elif kind == 131 and number == self.sent:
            self.acknowledged = number
        elif kind == 132:
            self.over = True

    def sendall(self, data):
        while data:
            piece, data = data[:self.most], data[self.most:]
            self.sent = (self.sent + 1) % 65536
            self.acknowledged = None
            self.again(lambda: self.packet(2, self.sent, piece), lambda: self.acknowledged == self.sent)  # pylint: disable=W0640

    def recv(self, count):
        until = time.monotonic() + self.limit
        while not self.data:
            if self.over or time.monotonic() > until:
                raise Gone()
            self.hear(0.2)
        part, self.data = self.data[:count], self.data[count:]
        return part

    def close(self, tell=True):
        if tell and not self.over:
            self.packet(4, 0)
        os.close(self.fd)


def as_gateway(path, driver):
    """A session that asks for the role io, and serves points."""
    gateway = Client(path, hello=False)
    gateway.hello(role=4)
    gateway.io_begin(driver)
    return gateway


class Client:
    """One session. `told` collects the frames that were not asked for: (request, fields)."""

    def __init__(self, path, hello=True):
        if isinstance(path, Line):
            self.stream = path
        else:
            self.stream = socket.socket(socket.AF_UNIX)
            self.stream.settimeout(60)
            self.stream.connect(path)
        self.request, self.told = 0, []
        if hello:
            self.hello()

    def close(self):
        self.stream.close()

    def receive(self, count):
        data = b''
        while len(data) < count:
            part = self.stream.recv(count - len(data))
            if not part:
                raise Gone()
            data += part
        return data

    def frame(self):
        """(service, flags, request, fields) of the next frame."""
        data = self.receive(struct.unpack('<I', self.receive(4))[0])
        service, flags, request = struct.unpack('<BBH', data[:4])
        return service, flags, request, Fields(data[4:])

    def send(self, service, body, request=None):
        if request is None:
            self.request = self.request % 65535 + 1
            request = self.request
        try:
            self.stream.sendall(struct.pack('<IBBH', 4 + len(body), service, 0, request) + body)
        except BrokenPipeError:
            pass  # the board may have said why before it closed the stream
        return request

    def answer(self, request):
        while True:
            _service, flags, number, fields = self.frame()
            if flags & 4:
                self.told.append((number, fields))
                continue
            assert number in (0, request), (number, request)
            if flags & 2:
                raise Refused(fields.number('H'), fields.text())
            return fields

    def call(self, service, body=b'', request=None):
        return self.answer(self.send(service, body, request))

    def next_told(self):
        while not self.told:
            _service, flags, number, fields = self.frame()
            assert flags & 4
            self.told.append((number, fields))
        return self.told.pop(0)

    # ---- services ----

    def hello(self, lowest=1, highest=1, role=None):
        it = self.call(HELLO, struct.pack('<IHH', 1196315986, lowest, highest) + text('client.py') +
                       (b'' if role is None else bytes([role])))
        assert it.number('I') == 1196315986
        self.version, self.role, self.session = it.number('H'), it.number('B'), it.number('B')
        self.software, self.board = it.text(), it.text()

    def status(self):
        it = self.call(STATUS)
        found = {'mode': it.number('B'), 'lines': it.number('B'), 'forces': it.number('H'),
                 'program': it.take(32)}
        for name in 'scans missed resets'.split():
            found[name] = it.number('Q')
        for name in 'period mean longest p999 late_mean late_longest late_p999'.split():
            found[name] = it.number('q')
        found['failed'], found['cpu'] = it.number('I'), it.number('I')
        found['memory'], found['up'] = it.number('Q'), it.number('Q')
        found['sessions'], found['points'] = it.number('I'), it.number('I')
        found['calls_failed'] = it.number('Q')
        for name in 'board version fault failed_at stop'.split():
            found[name] = it.text()
        found['tasks'] = [{'name': it.text(), 'interval': it.number('q'), 'runs': it.number('Q'),
                           'missed': it.number('Q'), 'last': it.number('q'), 'longest': it.number('q')}
                          for _ in range(it.number('B'))]
        found['next'], found['next_why'], found['disk'] = it.number('B'), it.text(), it.text()
        for task in found['tasks']:
            task['interrupted'], task['waited'] = it.number('Q'), it.number('q')
        found['speed'] = it.number('I')
        found['began'] = it.number('B'), it.number('H'), it.number('I')
        found['gateways'] = {}
        for _ in range(it.number('B') if it.rest() else 0):  # a small board has none
            driver = it.text()
            found['gateways'][driver] = {
                'runs': it.number('B') == 1, 'points': it.number('I'), 'user': it.text(), 'text': it.text(),
                'units': {it.text(): tuple(it.number('Q') for _ in range(3)) for _ in range(it.number('H'))}}
        if it.rest():  # a small board has none
            found['values'] = tuple(it.number('I') for _ in range(3))
            found['not good'] = {it.text(): it.number('B') for _ in range(it.number('H'))}
        assert not it.rest()
        return found

    def devices(self, anew=True):
        """[(driver, device, label, channel, about, unit, offset, flags, value)], once the board has looked."""
        found, first = [], 0
        while True:
            it = self.call(DEVICES, struct.pack('<BI', anew, first))
            ready, first, anew = it.number('B'), it.number('I'), False
            for _ in range(it.number('H')):
                found.append((*(it.text() for _ in range(6)), it.number('I'), it.number('B'), it.number('d')))
            assert not it.rest()
            if ready and not first:
                return found
            time.sleep(0 if ready else 0.02)

    def symbols(self):
        found, first = {}, 0
        while True:
            it = self.call(SYMBOLS, struct.pack('<I', first))
            first = it.number('I')
            for _ in range(it.number('H')):
                name, kind, flags, place = it.text(), it.number('B'), it.number('B'), it.number('I')
                found[name] = (kind, flags, place, it.text())
            if not first:
                return found

    def read(self, *names):
        it = self.call(READ, struct.pack('<H', len(names)) + b''.join(map(ref, names)))
        self.mode, self.scan, self.time = it.number('B'), it.number('Q'), it.number('q')
        assert it.number('H') == len(names)
        found = []
        self.quality = []
        for _ in names:
            self.quality.append(it.number('B'))
            found.append(it.value(it.number('B')))
        return found

    def publish(self, names, period_us=10000):
        request = self.send(PUBLISH, struct.pack('<IBH', period_us, 0, len(names)) +
                            b''.join(map(ref, names)))
        it = self.answer(request)
        count = it.number('I')
        return request, [it.number('B') for _ in range(count)]

    def publish_cells(self, name, period_us=10000):
        request = self.send(PUBLISH, struct.pack('<IB', period_us, 1) + text(name))
        return request, self.answer(request).number('I')

    def expect(self, mode=ANY, program=None):
        return bytes([mode]) + (program or self.status()['program'])

    def change(self, service, values, **expect):
        """values: {name: (type, value)}"""
        return self.call(service, self.expect(**expect) + struct.pack('<H', len(values)) +
                         b''.join(ref(name) + bytes([kind]) + value(kind, it)
                                  for name, (kind, it) in values.items())).number('Q')

    def write(self, values, **expect):
        return self.change(WRITE, values, **expect)

    def force(self, values, **expect):
        return self.change(FORCE, values, **expect)

    def unforce(self, *names, **expect):
        self.call(UNFORCE, self.expect(**expect) + struct.pack('<H', len(names)) +
                  b''.join(map(ref, names)))

    def forces(self):
        it = self.call(FORCES)
        found = {}
        for _ in range(it.number('H')):
            it.number('I')
            name, kind = it.text(), it.number('B')
            found[name] = (it.value(kind), it.value(kind))
        return found

    def set_mode(self, wish, **expect):
        self.call(MODE, self.expect(**expect) + bytes([wish]))

    def begin(self, parts):
        """parts: image, map, sources. Returns how many bytes are there already."""
        return self.call(DOWNLOAD, struct.pack('<III', *map(len, parts)) +
                         hashlib.sha256(b''.join(parts)).digest()).number('I')

    def send_from(self, data, at, most=60000):
        while at < len(data):
            at = self.call(BLOCK, struct.pack('<I', at) + data[at:at + most]).number('I')

    def sums(self, block, first=0):
        """(bytes of the program that runs, [(weak, strong)])"""
        found = []
        while True:
            it = self.call(SUMS, struct.pack('<IH', first + len(found), block))
            size = it.number('I')
            while it.rest():
                found.append((it.number('I'), it.take(8)))
            if first + len(found) == size // block:
                return size, found

    def pieces(self, at, *pieces):
        """pieces: bytes, or (from, how many) of the program that runs. Returns how much is there."""
        body = struct.pack('<I', at)
        for piece in pieces:
            if isinstance(piece, bytes):
                body += struct.pack('<BH', 1, len(piece)) + piece
            else:
                body += struct.pack('<BII', 0, *piece)
        return self.call(PIECES, body).number('I')

    def verify(self):
        """(same map, identity, how many losses, {name: why})"""
        it = self.call(VERIFY)
        same, identity, count = it.number('B'), it.take(32), it.number('I')
        losses = {}
        for _ in range(it.number('I')):
            why = it.number('B')
            losses[it.text()] = why
        return same, identity, count, losses

    def unlock(self, password):
        self.call(PASSWORD, b'\0' + text(password))

    def set_password(self, old, new, **expect):
        self.call(PASSWORD, b'\1' + self.expect(**expect) + text(old) + text(new))

    def has_password(self):
        return self.call(PASSWORD, b'\2').number('B') == 1

    # ---- of a gateway ----

    def io_begin(self, driver):
        """The number of points; the map is known afterwards."""
        it = self.call(IO_BEGIN, text(driver))
        self.map, size, points = it.number('I'), it.number('I'), it.number('I')
        self.map_text = b''
        while len(self.map_text) < size:
            it = self.call(IO_MAP, struct.pack('<II', self.map, len(self.map_text)))
            assert it.number('I') == size
            self.map_text += it.rest()
        return points

    def io_put(self, *values):
        """values: (point, type, value), or (point, type, None) for one that could not be read."""
        self.call(IO_PUT, struct.pack('<IH', self.map, len(values)) + b''.join(
            struct.pack('<IBB', point, it is not None, kind) + value(kind, it or 0) for point, kind, it in values))

    def io_outputs(self):
        self.outputs = self.send(IO_OUTPUTS, struct.pack('<I', self.map))
        self.answer(self.outputs)

    def next_outputs(self):
        """(mode, held, {point: (serial, value)}) of the next frame of outputs."""
        while True:
            number, it = self.next_told()
            if number == self.outputs:
                break
        mode, held, found = it.number('B'), it.number('B') == 1, {}
        for _ in range(it.number('H')):
            point, serial, kind = it.number('I'), it.number('I'), it.number('B')
            found[point] = serial, it.value(kind)
        assert not it.rest()
        return mode, held, found

    def window(self, number, first, count, form):
        it = self.call(IO_WINDOW, struct.pack('<BIIIH', 0, self.map, number, first, count))
        self.mode, self.scan = it.number('B'), it.number('Q')
        found = [it.number(form) for _ in range(count)]
        assert not it.rest()
        return found

    def set_window(self, number, first, form, *values):
        self.call(IO_WINDOW, struct.pack('<BIIIH', 1, self.map, number, first, len(values)) +
                  struct.pack(f'<{len(values)}{form}', *values))

    def io_report(self, words, units):
        """units: {name: (requests, errors, requests without an answer)}"""
        self.call(IO_REPORT, struct.pack('<I', self.map) + text(words) + struct.pack('<H', len(units)) +
                  b''.join(text(name) + struct.pack('<QQQ', *counts) for name, counts in units.items()))

    def retained(self):
        """(whether the board keeps them, clock, {name: (type, bytes)})"""
        data = b''
        while True:
            it = self.call(RETAIN, struct.pack('<BI', 0, len(data)))
            keeps, size = it.number('B'), it.number('I')
            data += it.rest()
            if len(data) == size:
                break
        it = Fields(data)
        clock, found = it.number('q'), {}
        for _ in range(it.number('I')):
            name, kind, _zero, value = it.number('H'), it.number('B'), it.take(1), it.number('I')
            name = it.take(name).decode()
            found[name] = (it.take(kind).decode(), it.take(value))
        assert not it.rest()
        return keeps, clock, found

    def send_retained(self, values, clock=0, most=60000):
        """values: {name: (type, bytes)}"""
        data = struct.pack('<qI', clock, len(values))
        for name, (kind, it) in values.items():
            data += struct.pack('<HBBI', len(name.encode()), len(kind), 0, len(it)) + name.encode() + kind.encode() + it
        for at in range(0, len(data), most):
            assert self.call(RETAIN, struct.pack('<BII', 1, len(data), at) + data[at:at + most]).number('I') == \
                min(len(data), at + most)

    def restore(self, check=False, **expect):
        """(how many values, how many not, {name: why})"""
        it = self.call(RETAIN, b'\2' + self.expect(**expect) + bytes([not check]))
        count, others, found = it.number('I'), it.number('I'), {}
        for _ in range(it.number('I')):
            why = it.number('B')
            found[it.text()] = why
        return count, others, found

    def commit(self, restart=False, back=None, **expect):
        more = b'' if back is None else struct.pack('<I', back)
        return self.call(COMMIT, self.expect(**expect) + bytes([restart]) + more).number('Q')

    def download(self, parts, restart=False, back=None, **expect):
        self.send_from(b''.join(parts), self.begin(parts))
        verified = self.verify()
        self.commit(restart, back, **expect)
        return verified

    def upload(self):
        data = b''
        while True:
            it = self.call(UPLOAD, struct.pack('<I', len(data)))
            sizes = [it.number('I') for _ in range(3)]
            data += it.rest()
            if len(data) == sum(sizes):
                return [data[:sizes[0]], data[sizes[0]:sizes[0] + sizes[1]], data[sizes[0] + sizes[1]:]]

    def config(self):
        """{key: (now, after the next start, flags, range)}"""
        it = self.call(CONFIG, b'\0')
        found = {}
        for _ in range(it.number('H')):
            key = it.text()
            found[key] = (it.text(), it.text(), it.number('B'), it.text())
        assert not it.rest()
        return found

    def set(self, key, setting, restart=False, **expect):
        """Whether it needs a restart."""
        return self.call(CONFIG, b'\1' + self.expect(**expect) + bytes([restart]) + text(key) + text(setting)).number('B')

    def record(self):
        """The whole log, as bytes."""
        data, start = b'', None
        while True:
            it = self.call(RECORD, struct.pack('<BQ', 0, (start or 0) + len(data)))
            oldest, end, at = (it.number('Q') for _ in range(3))
            if start is None or at != start + len(data):
                data, start, until = b'', at, end
            assert oldest <= at <= end
            data += it.rest()
            if start + len(data) >= until:
                return data[:until - start]

    def program(self, identity):
        """The image of a program that runs or ran."""
        data = b''
        while True:
            it = self.call(RECORD, b'\1' + identity + struct.pack('<I', len(data)))
            size = it.number('I')
            data += it.rest()
            if len(data) == size:
                return data

    def events(self, first=1):
        found = []
        while True:
            it = self.call(EVENTS, struct.pack('<I', first))
            count = it.number('H')
            for _ in range(count):
                found.append({'number': it.number('I'), 'time': it.number('q'), 'id': it.number('B'),
                              'role': it.number('B'), 'user': it.text(), 'args': [it.text(), it.text()]})
            if not count:
                return found
            first = found[-1]['number'] + 1

    def alarms(self, first=1):
        """The rows of the list, and the numbers before them."""
        found = []
        while True:
            it = self.call(ALARMS, struct.pack('<I', first))
            head = dict(zip(('active', 'waiting', 'lost', 'left_out'), [it.number('I') for _ in range(4)]))
            count = it.number('H')
            for _ in range(count):
                found.append({'number': it.number('I'), 'times': it.number('I'), 'state': it.number('B'),
                              'class': it.number('B'), 'came': it.number('q'), 'went': it.number('q'),
                              'acked': it.number('q'), 'name': it.text(), 'text': it.text(), 'who': it.text()})
            if not count:
                return found, head
            first = found[-1]['number'] + 1

    def clock(self, at=0, change=0):
        """The clock of the board; @change: 1: set it to @at, 2: even if a time server keeps it."""
        it = self.call(CLOCK, struct.pack('<Bq', change, at))
        return {'time': it.number('q'), 'zone_s': it.number('i'), 'sync': it.number('B'), 'zone': it.text()}

    def ack(self, number=0):
        return self.call(ACK, struct.pack('<I', number)).number('I')


def take_values(fields, types):
    """A message about variables: (mode, scan, time, lost, {index: (quality, value)})."""
    assert fields.number('B') == 0
    mode, scan, time, lost = fields.number('B'), fields.number('Q'), fields.number('q'), fields.number('I')
    changed = {}
    for _ in range(fields.number('H')):
        index = fields.number('H')
        changed[index] = (fields.number('B'), fields.value(types[index]))
    assert not fields.rest()
    return mode, scan, time, lost, changed


def take_cells(fields, count):
    """A message about cells: (scan, [(power in, power out)])."""
    assert fields.number('B') == 1
    fields.number('B')
    scan = fields.number('Q')
    fields.number('q')
    fields.number('I')
    packed = fields.rest()
    assert len(packed) == (count + 3) // 4
    return scan, [(packed[i // 4] >> 2 * (i % 4) & 1, packed[i // 4] >> 2 * (i % 4) + 1 & 1)
                  for i in range(count)]


class Log(Fields):
    """Takes the records of a log: (kind, fields), as docs/record.md has them."""

    def count(self):
        number = shift = 0
        while True:
            byte = self.number('B')
            number |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return number

    def signed(self):
        number = self.count()
        return -(number + 1 >> 1) if number & 1 else number >> 1

    def value_of(self, place):
        return self.take(self.count()) if place >> 24 == STRING else self.take(8)

    def key(self, why):
        self.take(4)
        key = {'why': why, 'program': self.take(32), 'scan': self.number('Q'), 'time': self.number('q')}
        self.take(16)
        key['mode'], key['fault'], key['flags'] = self.number('B'), self.number('B'), self.number('B')
        self.take(64)
        tasks, forces, size = self.number('B'), self.number('I'), self.number('I')
        self.take(37 * tasks)
        key['forces'] = [(self.number('I'), self.take(16)) for _ in range(forces)]
        key['data'] = self.take(size)
        return key

    def next(self):
        head = self.number('B')
        kind = head & 7
        if kind == 0:
            scan = {'time': self.signed(), 'wall': self.signed(), 'took': self.count()}
            for _ in range((head >> 6 & 1) + (head >> 7)):
                self.signed()
            return 'scan', scan
        if kind == 1:
            return 'key', self.key(head >> 3)
        if kind == 2:
            runs = []
            while True:
                gap, size = self.count(), self.count()
                if not size:
                    return 'inputs', runs
                runs.append((gap, self.take(size)))
        if kind in (3, 4):
            place = self.number('I')
            return ('write', 'force')[kind - 3], (place, self.value_of(place))
        if kind == 5:
            return 'release', self.number('I')
        assert head in (6, 14, 22), head
        return {6: 'stop', 14: 'fault', 22: 'tasks'}[head], self.number('B') if head > 6 else None
