# SPDX-License-Identifier: MIT
"""finder - finds the widgets of the editor by their accessible names, and their places on the screen.

One call returns all visible widgets: walk.c is loaded into the editor for it; a call for each would take most of a
test's time. Without walk.c (with sanitizers, under valgrind) one call of org.a11y.atspi.Cache returns all widgets, and
more calls tell which are visible. The palette holds most of the widgets and never changes: the search enters it only
for its tiles.
"""
import os
import re

from node import A11Y, EXTENTS, ROLES, WHOLE, Gone, Node
from screen import PATIENCE, dbus, sh, until, urge


class Finder:
    """The widgets of an editor. Editor in desk.py sets: screen, pid, name, root, window, scale,
    palette, quick (walk.c is there)."""

    # ---- asking ----

    def call(self, name, path, interface, method):
        return self.bus.call_blocking(name, path, A11Y + interface, method, '', ())

    def ask(self, questions, within=A11Y):
        """Sends all calls (path, interface, method, signature, arguments…) at once, returns the answers; None: the
        widget is gone."""
        answers, waiting = [None] * len(questions), []
        for index, (path, interface, method, *args) in enumerate(questions):
            message = dbus.lowlevel.MethodCallMessage(self.name, path, within + interface, method)
            message.append(*args[1:], signature=args[0] if args else '')

            def done(answer, index=index):
                if isinstance(answer, dbus.lowlevel.MethodReturnMessage):  # otherwise it went away meanwhile
                    answers[index] = answer.get_args_list()
            waiting.append(self.bus.send_message_with_reply(message, done, 60))
        for reply in waiting:
            reply.block()
        self.alive()
        return answers

    # ---- seeing ----

    def below(self, path):
        """The widget and all visible ones in it, each level after the one above: path -> node. The walk of walk.c."""
        try:
            rows = self.bus.call_blocking(self.name, '/rungboard/walk', 'rungboard.Walk', 'Walk', 'osu', (path, 'Elements', 49))
        except dbus.exceptions.DBusException:
            self.alive()
            raise
        return {str(row[0]): Node(self, str(row[0]), str(row[1]), *row[2:4], str(row[4]), *row[5:]) for row in rows}

    def known(self):
        """The visible widgets: path -> node. Without walk.c all that the toolkit knows, visible or not."""
        if self.quick:
            return self.below(self.root)
        try:
            items = self.bus.call_blocking(self.name, '/org/a11y/atspi/cache', A11Y + 'Cache', 'GetItems', '', ())
        except dbus.exceptions.DBusException:
            self.alive()
            raise
        nodes = [Node.of_cache(self, item) for item in items]
        return {node.path: node for node in nodes}

    def seen(self, nodes, top=None):
        """The visible paths below each node: path -> paths in order. A hidden widget has the place of the next
        visible one, and a new one is unknown until it is asked for: so all are asked, except parts of widgets that
        never hide any, and the palette unless it is @top."""
        family = {path: [] for path in nodes}
        for node in nodes.values():
            family.setdefault(node.parent, []).append(node)
        below, asked, paths = {}, [], [self.root] + ([top] if top else [])
        while paths:
            path = paths.pop()
            node, children = nodes.get(path), sorted(family.get(path, []), key=lambda child: child.place)
            if node and not node.children and path != self.root:
                continue
            below[path] = [child.path for child in children]
            if not node or node.role not in WHOLE or [child.place for child in children] != list(range(node.children)):
                asked.append(path)
            paths += [child for child in below[path] if child != self.palette]
        answers = self.ask([(path, 'Accessible', 'GetChildren') for path in asked])
        for path, answer in zip(asked, answers):
            below[path] = [child for _, child in answer[0]] if answer else []
        return below

    def waken(self, paths, known):
        """A widget appears on the bus when it is asked for, and its children then, too. The palette's stay away until
        tile() asks for them: each answer of the cache is a third shorter without them."""
        while paths:
            known |= paths
            if not self.palette:
                self.palette = self.named('Elements', 49, paths)
            asked = [path for path in paths if path != self.palette]
            answers = self.ask([(path, 'Accessible', 'GetChildren') for path in asked])
            paths = {child for answer in answers if answer for _, child in answer[0]} - known

    def named(self, name, role, paths):
        """The first of these widgets that has this role and name; None: none."""
        paths = list(paths)
        roles = self.ask([(path, 'Accessible', 'GetRole') for path in paths])
        fit = [path for path, answer in zip(paths, roles) if answer and answer[0] == role]
        names = self.ask([(path, 'Properties', 'Get', 'ss', A11Y + 'Accessible', 'Name') for path in fit],
                         'org.freedesktop.DBus.')
        return next((path for path, answer in zip(fit, names) if answer and answer[0] == name), None)

    def shown_as(self, text):
        """A text of the editor in the language that it shows."""
        return text

    @staticmethod
    def fits(node, name, role):
        return (role is None or node.role == ROLES[role]) and (name is None or name in node.name)

    def sole(self, name, role, nodes):
        """The only visible widget of @nodes whose name contains a text, of a role; None: none, several, or in the
        palette. It asks only the widgets around those that fit, where walk() asks nearly all."""
        name = name and self.shown_as(name)
        fit = [node for node in nodes.values() if self.fits(node, name, role)]
        ways = []
        for node in fit if len(fit) <= 8 else []:
            way = [node.path]
            while way[-1] != self.root and way[-1] in nodes and way[-1] != self.palette:
                way.append(nodes[way[-1]].parent)
            if way[-1] == self.root:
                ways.append(way)
        asked = list({path for way in ways for path in way[1:]})
        answers = self.ask([(path, 'Accessible', 'GetChildren') for path in asked])
        below = {path: {child for _, child in answer[0]} for path, answer in zip(asked, answers) if answer}
        seen = [way[0] for way in ways if all(child in below.get(path, ()) for child, path in zip(way, way[1:]))]
        return nodes[seen[0]] if len(seen) == 1 else None

    def walk(self, path=None, nodes=None):
        """@nodes: what known() has just returned."""
        if self.quick:
            nodes = nodes if nodes and not path else self.below(path or self.root)
            self.palette = next((each.path for each in nodes.values() if each.name == 'Elements' and each.role == 49), self.palette)
            yield from (node for node in nodes.values() if node.widget and (path or node.path != self.root))
            return
        unknown, before = {self.root}, set()
        while unknown - before:
            nodes, before = nodes if nodes and not before else self.known(), unknown
            below = self.seen(nodes, path)
            unknown = {child for paths in below.values() for child in paths if child not in nodes}
            self.waken(unknown, set(nodes))
        paths = [path] if path else below.get(self.root, [])
        while paths:
            level = [nodes[each] for each in paths if each in nodes]
            yield from level
            paths = []
            for node in level:
                if node.name == 'Elements' and node.role == 49:
                    self.palette = node.path
                if node.path != self.palette or node.path == path:
                    for child in below.get(node.path, []):
                        page = child in nodes and not nodes[child].widget
                        paths += below.get(child, []) if page else [child]

    def all(self, name=None, role=None, below=None, nodes=None):
        """All widgets whose name contains a text; of a role."""
        name = name and self.shown_as(name)
        return [node for node in self.walk(below, nodes) if self.fits(node, name, role)]

    def find(self, name=None, role=None, seconds=PATIENCE):
        def look():
            nodes = self.known()
            return not self.quick and self.sole(name, role, nodes) or next(iter(self.all(name, role, nodes=nodes)), None)
        return until(look, '%s "%s"' % (role or 'widget', name), seconds)

    def tile(self, name):
        """A tile of the palette."""
        return until(lambda: self.all(name, 'push button', self.palette), 'tile "%s"' % name)[0]

    def sheet(self):
        return self.find('Sheet')

    def elements(self):
        """The visible elements on sheets, without the wire or empty cell at the cursor."""
        return [node for node in self.all('Rung ', 'table cell') if not re.search(r', row \d+, column \w+$', node.name)]

    def cells(self):
        """Their names."""
        return [node.name for node in self.elements()]

    def says(self, text):
        """Waits until a text stands somewhere in the window."""
        return self.find(text)

    def shown(self, path):
        """The paths of the visible widgets in a widget."""
        return [child for _, child in self.call(self.name, path, 'Accessible', 'GetChildren')]

    def windows(self):
        """The windows that the window manager knows, without tooltips and popups. An empty answer may mean that a
        window closed during the search: it is repeated."""
        known = [int(number, 16) for number in re.findall('0x[0-9a-f]+', sh('xprop', '-root', '_NET_CLIENT_LIST'))]
        looks = (sh('xdotool', 'search', '--onlyvisible', '--pid', str(self.pid)).split() for _ in range(3))
        seen = next(filter(None, looks), [])
        return [window for window in seen if int(window) in known]

    def place(self, node=None):
        """Where a widget of the main window is on the screen, or its whole content: x, y, width, height."""
        about = dict(re.findall(r'(Absolute upper-left X|Absolute upper-left Y|Width|Height): +(-?\d+)',
                                sh('xwininfo', '-id', self.window)))
        _, _, width, height = self.ask([(self.shown(self.root)[0], *EXTENTS)])[0][0]
        x = int(about['Absolute upper-left X']) + (int(about['Width']) - width * self.scale) // 2
        y = int(about['Absolute upper-left Y']) + (int(about['Height']) - height * self.scale) // 2
        left, top, width, height = (each * self.scale for each in (self.at_rest(node) if node else (0, 0, width, height)))
        return x + left, y + top, width, height

    def at_rest(self, node):
        """The same once it has stopped moving: new widgets still move. A list that is made anew has another widget of
        that name; a person takes that one."""
        seen, misses = [], []

        def look():
            try:
                seen.append(node.box())
            except Gone:
                node.path = next((each.path for each in self.all(node.name) if (each.name, each.role) == (node.name, node.role)), node.path)
                misses.append(node.path)
            return len(misses) > 20 or len(seen) > 1 and seen[-1] == seen[-2] and seen[-1][2] > 0 and seen[-1]
        box = until(look, '"%s" to be at rest' % node.name)
        if box is True:
            raise Gone('"%s" is gone' % node.name)
        return box

    def centre(self, node):
        x, y, width, height = self.place(node)
        return x + width // 2, y + height // 2

    def popped(self, node):
        """The middle of a widget in a popover, which is a window of exactly its size."""
        left, top, width, height = self.at_rest(node)
        nodes = self.known()
        windows = [re.findall(r'(?:upper-left [XY]|Width|Height): +(-?\d+)', sh('xwininfo', '-id', each))
                   for each in sh('xdotool', 'search', '--onlyvisible', '--class', 'ladder-editor').split()]
        while node.parent in nodes:
            node = nodes[node.parent]
            x0, y0, *size = node.box() if node.widget else (0, 0)
            for about in windows:
                x, y, _, _, *of_window = [int(number) for number in about]
                if size and of_window == size:
                    return x + left - x0 + width // 2, y + top - y0 + height // 2
        raise AssertionError('"%s" is in no popover' % node.name)

    def grid(self, rung_y, column):
        """A point of the sheet: so many px below its top, in the middle of a column of 98 px."""
        x, y, _, _ = self.place(self.sheet())
        return x + 61 + 98 * column + 49, y + rung_y

    def element(self, *parts):
        """The element of a rung whose name has all these parts; waits for it."""
        def look():
            found = [node for node in self.elements() if all(part in node.name for part in parts)]
            return found[0] if found else None
        return until(look, 'the element %s' % ', '.join(parts))

    def middle(self, node):
        """Where the contact or coil of an element is; its wire is 46 px below its top."""
        x, y, width, _ = self.place(node)
        return x + width // 2, y + 46

    def beside(self, node):
        """A point on the wire of an element: a click there only moves the cursor."""
        x, y, _, _ = self.place(node)
        return x + 12, y + 46

    def wire_end(self, rung_y, bar, by=0):
        """The left end of a column, and so many px to its right."""
        x, y, _, _ = self.place(self.sheet())
        return x + 61 + 98 * bar + by, y + rung_y

    def hover(self, at, look=None):
        """Moves the pointer over a widget or a point, and waits for its tooltip; @look: returns it. Each movement starts
        the half second anew after which the toolkit shows the tooltip: so the pointer rests some seconds."""
        x, y = at if isinstance(at, tuple) else self.centre(at)
        move = lambda: sh('xdotool', 'mousemove', str(x - 2), str(y), 'sleep', '0.1', 'mousemove', str(x), str(y))
        move()
        return urge(look or self.tips, move, 'the words below the pointer', wait=5)

    def tips(self):
        """Tooltips and popups: the visible windows that the window manager does not know."""
        known = self.windows()
        return [window for window in sh('xdotool', 'search', '--onlyvisible', '--pid', str(self.pid)).split()
                if window not in known]

    def shot(self, name):
        """Takes a picture for a person to look at, if PICTURES names a folder."""
        if os.environ.get('PICTURES'):
            sh('import', '-window', 'root', os.path.join(os.environ['PICTURES'], name + '.png'))
