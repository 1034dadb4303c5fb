# SPDX-License-Identifier: MIT
"""node - a widget as the accessibility bus knows it: name, role, states, box.

finder.py finds widgets, desk.py uses them.
"""
WHOLE = {7, 11, 29, 37, 43, 48, 56, 61, 62, 90}  # roles of widgets that never hide a part
ROLES = {'slider': 51, 'check box': 7, 'combo box': 11, 'list': 31, 'menu item': 35, 'spin button': 52,
         'dialog': 16, 'picture': 27, 'frame': 23, 'label': 29, 'list item': 32, 'page tab': 37, 'panel': 39, 'push button': 43, 'radio button': 44,
         'table': 55, 'table cell': 56, 'table row': 90, 'text': 61, 'toggle button': 62, 'entry': 79}
A11Y = 'org.a11y.atspi.'
EXTENTS = ('Component', 'GetExtents', 'u', 1)  # in the window


class Gone(AssertionError):
    """The widget was destroyed during a query."""


class Node:
    """A widget on the accessibility bus."""

    def __init__(self, editor, *row):
        """@row: as walk.c returns it."""
        self.editor = editor
        # The place and number of children are among the visible ones.
        self.path, self.parent, self.place, self.children, self.name, self.role, self.states, self.widget = row

    @staticmethod
    def of_cache(editor, item):
        """@item: as org.a11y.atspi.Cache.GetItems returns it."""
        widget = A11Y + 'Component' in item[5]  # a page of a stack is not visible itself: only its content is
        return Node(editor, str(item[0][1]), str(item[2][1]), int(item[3]), int(item[4]), str(item[6]), int(item[7]),
                    int(item[9][0]), widget)

    def ask(self, *question):
        answer = self.editor.ask([(self.path, *question)])[0]
        if answer is None:
            raise Gone('"%s" is gone' % self.name)
        return answer

    def box(self):
        """x, y, width, height in its window."""
        return self.ask(*EXTENTS)[0]

    def press(self):
        """The accessible action that replaces a click: for windows other than the main one."""
        self.ask('Action', 'DoAction', 'i', 0)

    def text(self):
        return str(self.ask('Text', 'GetText', 'ii', 0, 1 << 20)[0])

    def has(self, state):
        """States as AtspiStateType counts: 4: checked, 11: focusable, 12: focused, 24: sensitive …"""
        return bool(self.ask('Accessible', 'GetState')[0][0] >> state & 1)
