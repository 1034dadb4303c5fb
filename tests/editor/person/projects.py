# SPDX-License-Identifier: MIT
"""projects - rung files that several tests start from."""

ONE_RUNG = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
END_PROGRAM
'''

TWO_RUNGS = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "one"
  | NO Start | NC Stop | COIL Motor |
RUNG "two"
  | NO Motor | COIL Lamp |
END_PROGRAM
'''
