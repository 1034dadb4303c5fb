/* SPDX-License-Identifier: MIT
 *
 * test_entry - quick entry: the meaning of lines, and their candidates.
 *
 * A case is a line as typed and the cell it makes, with its new declarations behind `+`,
 * and `below` before it if it goes in parallel; or `!` and the reason. A line typed in the
 * last column begins with `>`.
 */
#include "editor-gtk/edit/entry_duplicate.h"
#include "editor-gtk/edit/entry_names.h"
#include "engine/base/diag.h"
#include "engine/ladder.h"
#include "engine/text/text.h"
#include "tests/tap.h"

#include <stdlib.h>

static const char project_text_[] =
	"RUNGBOARD 1\n"
	"TYPE\nPair : STRUCT\nLow : INT;\nOn : BOOL;\nEND_STRUCT;\nEND_TYPE\n"
	"VAR\n"
	"  Start AT %IX0.0 : BOOL; (* green *)\n"
	"  Stop  AT %IX0.1 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL; (* fan contactor *)\n"
	"  Fan   AT %QX0.1 : BOOL;\n"
	"  Level : INT;\n"
	"  Heat  : REAL;\n"
	"  Wait  : TIME := T#5s;\n"
	"  FanDelay : TON;\n"
	"  TM0_Pause : TON;\n"
	"  X3 : BOOL;\n"
	"  Lamps AT %QX1.0 : ARRAY[0..7] OF BOOL;\n"
	"  P1 : Pair;\n"
	"  i : INT;\n"
	"END_VAR\n"
	"VAR CONSTANT\n  Full : INT := 9;\nEND_VAR\n"
	"FUNCTION_BLOCK Drive LD\nVAR_INPUT\nGo : BOOL;\nSpeed : INT;\nEND_VAR\n"
	"VAR_OUTPUT\nRun : BOOL;\nEND_VAR\nRUNG\n| NO Go | COIL Run |\nEND_FUNCTION_BLOCK\n"
	"PROGRAM Main LD\n"
	"RUNG Top\n| NO Start | NC Stop | COIL Motor |\n"
	"RUNG\n| NO I7 | TON FanDelay PT:=T#5s | COIL %QX0.2 |\n"
	"END_PROGRAM\n"
	"SUBROUTINE Alarm LD\nRUNG\n| NO Start | COIL %MX0.0 |\nEND_SUBROUTINE\n";

static const struct { const char *line, *means; } lines[] = {
	/* every dialect */
	{ "XIC Start", "NO Start" }, { "xio start", "NC Start" },
	{ "LD Start", "NO Start" }, { "LDI Start", "NC Start" },
	{ "LDN Start", "NC Start" }, { "A Start", "NO Start" },
	{ "AN Start", "NC Start" }, { "AND Start", "NO Start" },
	{ "ANI Start", "NC Start" }, { "O Start", "below NO Start" },
	{ "ON Start", "below NC Start" }, { "OR Start", "below NO Start" },
	{ "ORI Start", "below NC Start" }, { "NO Start", "NO Start" },
	{ "P Start", "P Start" }, { "LDP Start", "P Start" }, { "OSR Start", "P Start" },
	{ "N Start", "N Start" }, { "-| |- Start", "NO Start" },
	{ "-|/|- Start", "NC Start" }, { "-||- Start", "NO Start" },
	{ "-(S)- Motor", "S Motor" }, { "-( )- Motor", "COIL Motor" },
	{ "()Motor", "COIL Motor" },
	{ "OTE Motor", "COIL Motor" }, { "OUT Motor", "COIL Motor" },
	{ "= Motor", "COIL Motor" }, { "=Motor", "COIL Motor" },
	{ "ST Motor", "COIL Motor" }, { "OTL Motor", "S Motor" },
	{ "SET Motor", "S Motor" }, { "S Motor", "S Motor" }, { "RST Motor", "R Motor" },
	{ "OTU Motor", "R Motor" }, { "R Motor", "R Motor" }, { "PLS Motor", "COILP Motor" },
	{ "INV", "NOT" }, { "NOT", "NOT" }, { "RET", "RET" }, { "TND", "END" },
	{ "END", "END" }, { "End", "NO End + End BOOL %IX0.2" },
	{ "ret", "NO ret + ret BOOL %IX0.2" },
	{ "JMP Top", "JMP Top" }, { "CALL Alarm", "CALL Alarm" }, { "JSR Alarm", "CALL Alarm" },
	{ "RETURN", "RET" }, { "RETC", "RET" }, { "Return", "NO Return + Return BOOL %IX0.2" },
	{ "-<RETURN>-", "RET" }, { "<RET>", "RET" }, { "--<END>", "END" }, { "-<STOP>-", "STOP" },
	{ "<NEXT>", "NEXT" }, { "<FROB>", "! “< FROB >” is not a valid expression" },
	{ " >>Top", "JMP Top" }, { "->> Top", "JMP Top" }, { "-->>Top", "JMP Top" }, { " >>", "part" },
	{ ">>>Top", "JMP Top" }, { "JMPC Top", "JMP Top" }, { ">-<RETURN>-", "RET" },
	{ "RETURN Top", "! “Top” is not expected: this word has no operand" },
	{ "<RET> Top", "! “Top” is not expected: this word has no operand" },
	/* names alone */
	{ "Start", "NO Start" }, { "start", "NO Start" }, { "/Stop", "NC Stop" },
	{ "/ Stop", "NC Stop" }, { ">Motor", "COIL Motor" }, { ">/Motor", "COILNOT Motor" },
	{ "NO /Start", "NC Start" }, { "COIL /Motor", "COILNOT Motor" },
	{ "P /Start", "N Start" }, { "P NOT Start", "N Start" }, { "N NOT Start", "P Start" },
	{ "NC NOT Start", "NO Start" }, { "COIL NOT Motor", "COILNOT Motor" },
	{ "FanDelay", "NO FanDelay.Q" }, { "FanDelay.Q", "NO FanDelay.Q" },
	{ "Level.3", "NO Level.3" }, { ">level.%X15", "COIL Level.%X15" }, { "S P1.Low.4", "S P1.Low.4" },
	{ "/Level.0", "NC Level.0" }, { "Level.16", "! “Level.16”: the number has no such bit" },
	{ "%MW4.%X3", "NO %MW4.%X3" }, { ">%MW4.3", "COIL %MX4.3" }, { "FanDelay.Q.1", "! “FanDelay.Q.1” does not exist: the variable has no elements and no members" },
	{ "Heat.1", "! “Heat.1” does not exist: the variable has no elements and no members" },
	{ "Level.%B0", "! “Level.%B0” is not a BOOL: compare it, as in Level > 5" }, { "MOVE IN:=Level.%B1", "MOVE IN:=Level.%B1" },
	{ "Lamps[3]", "NO Lamps[3]" }, { ">lamps[i]", "COIL Lamps[i]" },
	{ "P1.On", "NO P1.On" },
	/* addresses */
	{ "%IX0.0", "NO Start" }, { "I0.0", "NO Start" }, { "i0.1", "NO Stop" },
	/* bits as other tools spell them; leading zeros and letters of any size are read */
	{ "IX3.0", "NO %IX3.0" }, { "qx3.7", "NO %QX3.7" }, { "MX3.1", "NO %MX3.1" }, { "i3.07", "NO %IX3.7" },
	{ "Q03.1", "NO %QX3.1" }, { "M3.2", "NO %MX3.2" }, { "V3.2", "NO %VX3.2" }, { "S3.2", "NO %SX3.2" },
	{ "SM0.0", "NO %SMX0.0" }, { "SM0.1", "NO %SMX0.1" }, { "SM0.4", "NO %SMX0.4" }, { "%I27", "NO %IX3.3" },
	{ "%Q27", "NO %QX3.3" }, { "%B27", "NO %MX3.3" }, { "M27", "NO %MX3.3" },
	{ "I3.8", "! “I3.8” is not an address: the bits of a byte are 0 to 7" },
	/* numbers */
	{ "IW2 > 5", "[ %IW2 > 5 ]" }, { "MB3 > 5", "[ %MB3 > 5 ]" }, { "MW4 > 5", "[ %MW4 > 5 ]" },
	{ "MD8 > 5", "[ %MD8 > 5 ]" }, { "VB3 > 5", "[ %VB3 > 5 ]" }, { "VW4 > 5", "[ %VW4 > 5 ]" },
	{ "VD8 > 5", "[ %VD8 > 5 ]" }, { "AIW4 > 5", "[ %AIW4 > 5 ]" }, { "AQW4 > 5", "[ %AQW4 > 5 ]" },
	{ "%W2 > 5", "[ %VD8 > 5 ]" },
	{ "I3", "NO %IX0.3" }, { "E0.3", "NO %IX0.3" }, { ">A4.0", "COIL %QX4.0" },
	{ "X5", "NO %IX0.5" }, { ">Y3", "COIL %QX0.3" }, { "I:1/3", "NO %IX2.3" },
	{ "%TM0.Q", "NO TM0_Pause.Q" }, { "/%tm0.q", "NC TM0_Pause.Q" }, { "%X3.A", "NO X3" },
	{ "%TM1.Q", "NO TM1.Q + TM1 CL_TON" }, { "/%T0.D", "NC T0.D + T0 CL_TIMER" },
	{ "%C0.D", "NO C0.D + C0 CL_COUNTER" }, { "%R2.e", "NO Reg2.E + Reg2 CL_REGISTER" },
	{ "%X0.A", "! “%X0.A” is no step of this program: a step is named as in Step0.X" },
	{ "T37", "NO T37.Q + T37 TON" }, { "/C0", "NC C0.Q + C0 CTU" }, { "P t1", "P t1.Q + t1 TON" },
	{ "T37.Q", "NO T37.Q + T37 TON" }, { "T37 : BOOL", "NO T37 + T37 BOOL" },
	{ ">C1", "COIL C1 + C1 BOOL %QX0.3" }, { ">%T0.R", "! “T0.R” cannot be written" },
	{ ">T5.Q", "! “T5.Q” cannot be written" },
	{ "D0 > 5", "[ D0 > 5 ] + D0 INT %VW0" }, { "D1 > 5.5", "[ D1 > 5.5 ] + D1 REAL %VD2" },
	{ "D0 := D2 + 1", "[ D0 := D2 + 1 ] + D0 INT %VW0 + D2 INT %VW4" },
	{ "D9000 > 5", "! “D9000” is not an address of this project" },
	{ "%C1.V > 5", "[ C1.V > 5 ] + C1 CL_COUNTER" }, { "%W3 > 5", "[ %VD12 > 5 ]" },
	{ "T37.ET > 5s", "[ T37.ET > T#5s ] + T37 TON" }, { "T1 > 50", "[ T1 > 50 ] + T1 INT" },
	{ "MOV 5 D0", "MOVE IN:=5 OUT=>D0 + D0 INT %VW0" },
	{ "%TM0.V", "! “%TM0.V” is not a pin or member" },
	{ "%TM0.Z", "! “%TM0.Z” is not an address: the areas are I, Q, M, V, S, SM, AI, AQ, XI, XQ, XAI, XAQ" },
	{ "O:0/10", "NO %QX1.2" }, { "%B3", "NO %MX0.3" }, { "SM0.5", "NO %SMX0.5" },
	{ "X10", "! “X10” is octal in some controllers and hexadecimal in others: "
		 "write %IX1.0" },
	{ "%IX0.9", "! “%IX0.9” is not an address: the bits of a byte are 0 to 7" },
	{ "%ZX0.9", "! “%ZX0.9” is not an address: the areas are I, Q, M, V, S, SM, AI, AQ, XI, XQ, XAI, XAQ" },
	{ "SYS_FIRST_SCAN", "NO SYS_FIRST_SCAN" },
	/* boxes */
	{ "TON", "TON Delay1 PT:=T#1s + Delay1 TON" },
	{ "TON T37", "TON T37 PT:=T#1s + T37 TON" },
	{ "TON T37 5s", "TON T37 PT:=T#5s + T37 TON" },
	{ "TON T37, 2.5s", "TON T37 PT:=T#2.5s + T37 TON" },
	{ "TON 5s", "TON Delay1 PT:=T#5s + Delay1 TON" },
	{ "TON FanDelay PT := Wait", "TON FanDelay PT:=Wait" },
	{ "TON FanDelay PT:=Later", "TON FanDelay PT:=Later + Later TIME" },
	{ "TOF FanDelay", "! “FanDelay” is not an instance of this block" },
	{ "CTU", "CTU Counter1 PV:=10 + Counter1 CTU" },
	{ "CTU Parts R:=/Stop PV:=3 CV=>Level",
	  "CTU Parts R:=/Stop PV:=3 CV=>Level + Parts CTU" },
	{ "CTU Parts QX:=3", "! “QX” is not a pin of this box" },
	{ "Drive", "Drive Drive1 + Drive1 Drive" },
	{ "Drive Left 7", "Drive Left Speed:=7 + Left Drive" },
	{ "RTO", "TONR Delay1 PT:=T#1s + Delay1 TONR" },
	{ "MOV 5 Level", "MOVE IN:=5 OUT=>Level" },
	{ "MOVE IN:=Level OUT=>i", "MOVE IN:=Level OUT=>i" },
	{ "ADD Level i Level", "ADD IN1:=Level IN2:=i OUT=>Level" },
	{ "ADD 1 2 3 Level", "ADD IN1:=1 IN2:=2 IN3:=3 OUT=>Level" },
	{ "GRT Level 5", "GT IN1:=Level IN2:=5" },
	{ "AND IN1:=Start IN2:=Stop", "AND IN1:=Start IN2:=Stop" },
	{ "INT_TO_REAL IN:=Level OUT=>Heat", "INT_TO_REAL IN:=Level OUT=>Heat" },
	{ "ADD IN1:=1 IN1:=2", "! “IN1” is given twice" },
	{ "ADD IN1:=", "! “IN1” needs a value" }, { "ADD 1 /", "! a value is missing" },
	{ "ADD IN1:=1 OUT=>5", "! “5” cannot be written" },
	{ "MOVE Level Full", "! “Full” cannot be written" },
	/* expressions */
	{ "Level > 5", "[ Level > 5 ]" }, { "Level>5", "[ Level > 5 ]" },
	{ "[ Level > 5 ]", "[ Level > 5 ]" }, { "[Level>5", "[ Level > 5 ]" },
	{ "Level := i + 1", "[ Level := i + 1 ]" }, { "Level:=i+1", "[ Level := i+1 ]" },
	{ "Lamps[i] = Start", "[ Lamps[i] = Start ]" },
	{ "P1.Low <= 7", "[ P1.Low <= 7 ]" }, { "(Level + 1) * 2 > i", "[ (Level + 1) * 2 > i ]" },
	{ "Temp > 5", "[ Temp > 5 ] + Temp INT" },
	{ "Temp > 5.5", "[ Temp > 5.5 ] + Temp REAL" },
	{ "Temp > T#5s", "[ Temp > T#5s ] + Temp TIME" },
	{ "Temp := Heat", "[ Temp := Heat ] + Temp REAL" },
	{ "Full := 5", "! “Full” cannot be written" },
	{ ">Level > 5", "! “Level > 5” cannot stand in the last column: only an output can" },
	{ ">Level := 5", "[ Level := 5 ]" },
	{ "Level >", "part" }, { "Level > (i +", "part" }, { "(Level + 1) *", "part" },
	{ "Level > 5)", "! “Level > 5)” is not a valid expression" },
	{ "Level > > 5", "! “Level > > 5” is not a valid expression" },
	{ "NO Level > 5", "[ Level > 5 ]" },
	/* new names are declared */
	{ "Open", "NO Open + Open BOOL %IX0.2" }, { ">Horn", "COIL Horn + Horn BOOL %QX0.3" },
	{ "NO Open", "NO Open + Open BOOL %IX0.2" },
	{ "S Horn", "S Horn + Horn BOOL %QX0.3" },
	{ "XIC 启动", "NO 启动 + 启动 BOOL %IX0.2" },
	/* given parts of a declaration are used */
	{ "Open %IX0.5", "NO Open + Open BOOL %IX0.5" },
	{ "Open AT %IX0.5", "NO Open + Open BOOL %IX0.5" },
	{ "Open : BOOL", "NO Open + Open BOOL" }, { "Open:bool", "NO Open + Open BOOL" },
	{ "Open at %IX0.5 : BOOL", "NO Open + Open BOOL %IX0.5" },
	{ "Open %IX0.5:BOOL", "NO Open + Open BOOL %IX0.5" },
	{ "Open AT I:0/5 : BOOL", "NO Open + Open BOOL %IX0.5" },
	{ "Open AT E0.5", "NO Open + Open BOOL %IX0.5" },
	{ "XIC Open %MX3.1", "NO Open + Open BOOL %MX3.1" },
	{ "OR Open : BOOL", "below NO Open + Open BOOL" },
	{ "-|/|- Open %IX0.5", "NC Open + Open BOOL %IX0.5" },
	{ "/Open %IX0.5", "NC Open + Open BOOL %IX0.5" },
	{ "OUT Lamp %QX0.5", "COIL Lamp + Lamp BOOL %QX0.5" },
	{ "SET Lamp AT %MX0.5", "S Lamp + Lamp BOOL %MX0.5" },
	{ "= Lamp : BOOL", "COIL Lamp + Lamp BOOL" },
	{ ">Lamp %QX0.5", "COIL Lamp + Lamp BOOL %QX0.5" },
	{ ">/Lamp : BOOL", "COILNOT Lamp + Lamp BOOL" },
	{ "启动 %IX0.5", "NO 启动 + 启动 BOOL %IX0.5" },
	{ "A %IX0.5", "NO %IX0.5" }, { "A AT %IX0.5", "NO A + A BOOL %IX0.5" },
	{ "A : BOOL", "NO A + A BOOL" },
	{ "Open %IX0.0", "NO Open + Open BOOL %IX0.0 beside Start" },
	{ ">Lamp %QX1.3", "COIL Lamp + Lamp BOOL %QX1.3 beside Lamps" },
	{ "Start %IX0.0", "NO Start" }, { "start AT I0.0 : BOOL", "NO Start" },
	{ "Start : BOOL", "NO Start" }, { "FanDelay : TON", "NO FanDelay.Q" },
	{ "Start %IX0.5", "! the name is declared already as Start AT %IX0.0 : BOOL" },
	{ "Start : INT", "! the name is declared already as Start AT %IX0.0 : BOOL" },
	{ "Lamps : BOOL", "! the name is declared already as Lamps AT %QX1.0 : ARRAY OF BOOL" },
	{ "FanDelay : TOF", "! the name is declared already as FanDelay : TON" },
	{ "Level : INT", "! “Level” is not a BOOL: compare it, as in Level > 5" },
	{ "OUT Start %IX0.0", "! “Start” cannot be written" },
	{ "Open %IW2", "! “%IW2” is not the address of a BOOL" },
	{ "Open %IX0.9", "! “%IX0.9” is not an address: the bits of a byte are 0 to 7" },
	{ "Open %IX60000.0", "! “%IX60000.0” is not an address of this project: its area ends at byte 511" },
	{ "Open %ZX0.1 : BOOL", "! “%ZX0.1” is not an address: the areas are I, Q, M, V, S, SM, AI, AQ, XI, XQ, XAI, XAQ" },
	{ "Open AT Start", "! “Start” is not an address" },
	{ "Open AT", "! “Open” needs an address behind AT" },
	{ "Open AT : BOOL", "! “Open” needs an address behind AT" },
	{ "Open :", "! “Open” needs a type behind the colon" },
	{ "Open : FROB", "! “FROB” is not a type" },
	{ "Open : INT", "! the type “INT” does not fit: this is a BOOL" },
	{ "Open : ARRAY[0..3] OF BOOL", "! the type “ARRAY[0..3] OF BOOL” does not fit: this is a BOOL" },
	{ "OUT Open : BOOL := TRUE",
	  "! “:= TRUE” is not expected: only an address and a type can follow a name" },
	{ "Open %IX0.5 now", "! “now” is not expected: only an address and a type can follow a name" },
	{ "OUT Lamp %IX0.5", "! “%IX0.5” cannot be written" },
	{ "PROGRAM : BOOL", "! “PROGRAM” cannot be the name of a variable" },
	{ "SYS_FIRST_SCAN : BOOL", "! “SYS_FIRST_SCAN” cannot be the name of a variable" },
	{ "P1.On %IX0.5", "! “P1.On” cannot be the name of a variable" },
	/* new names elsewhere get the type of their place */
	{ "TON D1 Later AT %ML4 : TIME", "TON D1 PT:=Later + D1 TON + Later TIME %ML4" },
	{ "TON D1 PT:=Later AT %ML4", "TON D1 PT:=Later + D1 TON + Later TIME %ML4" },
	{ "TON D1 PT:=Later : TIME ET=>Now", "TON D1 PT:=Later ET=>Now + D1 TON + Later TIME + Now TIME" },
	{ "TON D1 Q=>Done", "TON D1 Q=>Done + D1 TON + Done BOOL %QX0.3" },
	{ "TON D1 Later AT %MD4", "! the address is not as wide as its type: %MD4, TIME: %ML" },
	{ "TON D1 Later : INT", "! the type “INT” does not fit here" },
	{ "CTU Parts PV:=Most AT %MW8 CV=>Now AT %QW4",
	  "CTU Parts PV:=Most CV=>Now + Parts CTU + Most INT %MW8 + Now INT %QW4" },
	{ "CTU Parts R:=Zero CV=>Now AT %IW4", "! “%IW4” cannot be written" },
	{ "CTU Parts R:=Zero", "CTU Parts R:=Zero + Parts CTU + Zero BOOL %IX0.2" },
	{ "ADD Heat 2.5 Sum", "ADD IN1:=Heat IN2:=2.5 OUT=>Sum + Sum REAL" },
	{ "ADD 1 2.5 Sum AT %MD8", "ADD IN1:=1 IN2:=2.5 OUT=>Sum + Sum REAL %MD8" },
	{ "MOVE T#5s Kept", "MOVE IN:=T#5s OUT=>Kept + Kept TIME" },
	{ "MOVE 5 Kept : DINT", "MOVE IN:=5 OUT=>Kept + Kept DINT" },
	{ "SEL G:=Start IN0:=Heat IN1:=Hot OUT=>Sum",
	  "SEL G:=Start IN0:=Heat IN1:=Hot OUT=>Sum + Hot REAL + Sum REAL" },
	{ "INT_TO_REAL Level Sum", "INT_TO_REAL IN:=Level OUT=>Sum + Sum REAL" },
	{ "Temp AT %IW0 : INT > 80", "[ Temp > 80 ] + Temp INT %IW0 beside Start" },
	{ "Temp AT %IW0 > 80", "[ Temp > 80 ] + Temp INT %IW0 beside Start" },
	{ "Temp AT %ID4>80", "[ Temp > 80 ] + Temp DINT %ID4" },
	{ "Temp : LREAL > 80", "[ Temp > 80 ] + Temp LREAL" },
	{ "Temp > Limit AT %MD4 : REAL", "[ Temp > Limit ] + Temp REAL + Limit REAL %MD4" },
	{ "[ Temp AT %IW0 + 1 > 80 ]", "[ Temp + 1 > 80 ] + Temp INT %IW0 beside Start" },
	{ "NO Temp AT %IW0 > 80", "[ Temp > 80 ] + Temp INT %IW0 beside Start" },
	{ "Level > 5 AND Open", "[ Level > 5 AND Open ] + Open BOOL %IX0.2" },
	{ "Level > 5 AND Open AT %IX0.5", "[ Level > 5 AND Open ] + Open BOOL %IX0.5" },
	{ "Level > 5 AND (Open OR NOT Shut : BOOL)",
	  "[ Level > 5 AND (Open OR NOT Shut) ] + Open BOOL %IX0.2 + Shut BOOL" },
	{ "Temp > 5 AND Temp < 2.5 * Heat", "[ Temp > 5 AND Temp < 2.5 * Heat ] + Temp INT" },
	{ "Wait * Times > T#5s", "[ Wait * Times > T#5s ] + Times INT" },
	{ ">Sum := Heat + More", "[ Sum := Heat + More ] + Sum REAL + More REAL" },
	{ ">Sum AT %MD8 := Level + 1", "[ Sum := Level + 1 ] + Sum DINT %MD8" },
	{ "Sum : REAL := INT_TO_REAL(Level) / 276.48",
	  "[ Sum := INT_TO_REAL(Level) / 276.48 ] + Sum REAL" },
	{ ">Sum : REAL := 5.0", "[ Sum := 5.0 ] + Sum REAL" },
	{ ">Sum:REAL:=5.0", "[ Sum := 5.0 ] + Sum REAL" },
	{ ">[ Sum : LREAL := Heat ]", "[ Sum := Heat ] + Sum LREAL" },
	{ ">Sum : DINT := Level + More", "[ Sum := Level + More ] + Sum DINT + More INT" },
	{ ">Sum AT %MW4 : INT := Level + 5", "[ Sum := Level + 5 ] + Sum INT %MW4" },
	{ ">Sum AT %MW4:INT:=5", "[ Sum := 5 ] + Sum INT %MW4" },
	{ ">Sum AT %MW4 := 5", "[ Sum := 5 ] + Sum INT %MW4" },
	{ ">Sum AT %MW4:=5", "[ Sum := 5 ] + Sum INT %MW4" },
	{ ">Sum AT N7:4 := 5", "! “N7:4” is not an address: the areas are I, Q, M, V, S, SM, AI, AQ, XI, XQ, XAI, XAQ" },
	{ ">Horn AT O:0/5 : BOOL := Start", "[ Horn := Start ] + Horn BOOL %QX0.5" },
	{ ">Horn : BOOL := TRUE", "[ Horn := TRUE ] + Horn BOOL" },
	{ ">Level : INT := 5", "[ Level := 5 ]" },
	{ ">Level : DINT := 5", "! the name is declared already as Level : INT" },
	{ ">Sum : FROB := 5", "! “FROB” is not a type" },
	{ ">Sum : REAL :=", "part" },
	{ ">Sum AT %MX0.4 : INT := 5",
	  "! the address is not as wide as its type: %MX0.4, INT: %MW" },
	{ ">Sum : := 5", "! “Sum” needs a type behind the colon" },
	{ ">Sum AT %IW4 : INT := 5", "! “%IW4” cannot be written" },
	{ "MUL Level 2 Sum : DINT", "MUL IN1:=Level IN2:=2 OUT=>Sum + Sum DINT" },
	{ ">Sum := Level > Most", "[ Sum := Level > Most ] + Sum BOOL %QX0.3 + Most INT" },
	{ ">Level := LIMIT(0, More, Most)", "[ Level := LIMIT(0, More, Most) ] + More INT + Most INT" },
	{ ">Heat := SQRT(More)", "[ Heat := SQRT(More) ] + More REAL" },
	{ "Lamps[Which] AND Start", "[ Lamps[Which] AND Start ]" },
	{ "Mask : WORD AND 16#FF = 5", "[ Mask AND 16#FF = 5 ] + Mask WORD" },
	{ "Fresh AT I:0/5 : BOOL AND Level > 5",
	  "[ Fresh AND Level > 5 ] + Fresh BOOL %IX0.5" },
	{ "Fresh AT I:0/5 : BOOL = More", "[ Fresh = More ] + Fresh BOOL %IX0.5 + More BOOL %IX0.2" },
	{ "Temp AT %IX0.5 > 80", "! the address is not as wide as its type: %IX0.5, INT: %IW" },
	{ "Level AT %IW0 > 80", "! the name is declared already as Level : INT" },
	{ "Temp : FROB > 80", "! “FROB” is not a type" },
	{ "Level > 5 AND Open : INT", "! the type “INT” does not fit: this is a BOOL" },
	{ "Temp AT > 80", "! “Temp” needs an address behind AT" },
	/* what other tools set by themselves */
	{ "M8000", "! “M8000” is set by other controllers themselves: write SYS_ALWAYS_ON, which is the same here" },
	{ "XIC m8013", "! “m8013” is set by other controllers themselves: write SYS_CLOCK_1S, which is the same here" },
	{ "M8020", "! “M8020” is set by other controllers themselves; nothing sets it here: "
		   "write %MX1002.4 if you mean an ordinary address" },
	{ "M7999", "NO %MX999.7" }, { "M8512", "NO %MX1064.0" }, { "%MX1000.0", "NO %MX1000.0" },
	{ "D8000 > 5", "! “D8000” is set by other controllers themselves; nothing sets it here" },
	{ "SM400", "! “SM400” is set by other controllers themselves: write SYS_ALWAYS_ON, which is the same here" },
	{ "SM0.0", "NO %SMX0.0" }, { "SM0.5", "NO %SMX0.5" }, { "%SMX0.6", "NO %SMX0.6" },
	{ "SM0.6", "! “SM0.6” has another meaning in other controllers: "
		   "write %SMX0.6 if you mean the one of Rungboard" },
	{ "%S0", "! “%S0” is set by other controllers themselves: write SYS_CLOCK_1S, which is the same here" },
	{ "%S4 AND Level > 5", "! “%S4” is set by other controllers themselves: write SYS_FIRST_SCAN, which is the same here" },
	{ "%S9", "! “%S9” is set by other controllers themselves; nothing sets it here: "
		 "write %SX1.1 if you mean an ordinary address" },
	{ "S9", "NO %SX1.1" }, { "%SX0.0", "NO %SX0.0" },
	{ "NO M8002", "! “M8002” is set by other controllers themselves: write SYS_FIRST_SCAN, which is the same here" },
	/* addresses in an expression: the name of the variable there, else our spelling */
	{ "I0.0 AND Level > 5", "[ Start AND Level > 5 ]" },
	{ "Level > 5 AND %IX0.1", "[ Level > 5 AND Stop ]" },
	{ "I4 AND i0.0 OR NOT m0.3", "[ %IX0.4 AND Start OR NOT %MX0.3 ]" },
	{ "%mw4 + IW2 > 5", "[ %MW4 + %IW2 > 5 ]" }, { ">MW4 := MW6 + 1", "[ %MW4 := %MW6 + 1 ]" },
	{ ">Q0.1 := X1 AND E0.0", "[ Fan := Stop AND Start ]" },
	{ ">Level := MAX(mw2, IW4)", "[ Level := MAX(%MW2, %IW4) ]" },
	{ "%MW4.3 AND mw4.%X2", "[ %MX4.3 AND %MW4.%X2 ]" },
	{ "Lamps[3] AND I5", "[ Lamps[3] AND %IX0.5 ]" },
	/* wrong */
	{ "Level", "! “Level” is not a BOOL: compare it, as in Level > 5" },
	{ ">Start", "! “Start” cannot be written" },
	{ "FanDelay.X", "! “FanDelay.X” is not a pin or member" },
	{ "Start.Q", "! “Start.Q” does not exist: the variable has no elements and no members" },
	{ "Nobody.Q", "! “Nobody.Q” is not declared" },
	{ ">FanDelay", "! “FanDelay” is not a BOOL" },
	{ "FROB Start", "! “FROB” is not the word of an element or block" },
	{ ">NO Start", "! “NO” cannot stand in the last column: only an output can" },
	{ "RET now", "! “now” is not expected: this word has no operand" },
	{ "PROGRAM", "! “PROGRAM” cannot be the name of a variable" },
	{ "_T1", "! “_T1” cannot be the name of a variable" },
	{ "12", "! “12” cannot be the name of a variable" },
	{ "NO", "part" }, { "/", "part" }, { "JMP", "part" }, { "COIL", "part" },
	{ "", "nothing" }, { "   ", "nothing" },
};

static void say(struct project *project, const struct entry *e, char *out, size_t size)
{
	char cell_text[2200];
	struct cell cell;
	int n;

	if (e->sense == ENTRY_WRONG) {
		n = snprintf(out, size, "! ");
		snprintf(out + n, size - (size_t)n, e->why, e->what, e->instead);
		return;
	}
	if (e->sense != ENTRY_ELEMENT || !entry_cell(project, e, &cell)) {
		snprintf(out, size, "%s", e->sense == ENTRY_PART ? "part" : "nothing");
		return;
	}
	text_write_cell(project, &cell, cell_text, sizeof(cell_text));
	n = snprintf(out, size, "%s%s", e->below ? "below " : "", cell_text);
	for (int i = 0; i < e->declares; i++)
		n += snprintf(out + n, size - (size_t)n, " + %s %s%s%s%s%s",
			      e->declare[i].name, e->declare[i].type,
			      e->declare[i].address[0] ? " " : "", e->declare[i].address,
			      e->declare[i].shares[0] ? " beside " : "",
			      e->declare[i].shares);
}

static void check_lines(struct entry_place *place)
{
	for (size_t i = 0; i < sizeof(lines) / sizeof(*lines); i++) {
		const char *line = lines[i].line;
		struct entry entry;
		char got[4000];

		place->output = line[0] == '>';
		entry_read(place, line + place->output, &entry);
		say(place->project, &entry, got, sizeof(got));
		if (!CHECK_AS(!strcmp(got, lines[i].means), line))
			printf("# got:  %s\n# want: %s\n", got, lines[i].means);
	}
	place->output = false;
}

/* Candidates for a line with the cursor at `_`; `>` begins a line of the last column. */
static const struct { const char *line, *offers; } offered[] = {
	{ "Fan_", "Fan FanDelay" },
	{ "fa_", "Fan FanDelay new:fa@%IX0.2 new:fa@%MX0.1 new:fa@" },
	{ ">fa_", "Fan new:fa@%QX0.3 new:fa@%MX0.1 new:fa@" },
	{ "NO Mo_", "Motor new:Mo@%IX0.2 new:Mo@%MX0.1 new:Mo@" },
	{ "COIL Sta_", "new:Sta@%QX0.3 new:Sta@%MX0.1 new:Sta@" },
	{ "XIC tor_", "Motor new:tor@%IX0.2 new:tor@%MX0.1 new:tor@" },
	{ "FanDelay._", "FanDelay.IN FanDelay.Q" },
	{ "NO FanDelay.q_", "FanDelay.Q" },
	{ "TON _", "FanDelay TM0_Pause Q=> PT:= ET=>" },
	{ "TON Fa_", "FanDelay new:Fa@" },
	{ "TON FanDelay P_", "PT:= new:P@ new:P@%IL8 new:P@%ML8" },
	{ "TON FanDelay W_", "Wait new:W@ new:W@%IL8 new:W@%ML8" },
	{ "TON FanDelay PT:=W_", "Wait new:W@ new:W@%IL8 new:W@%ML8" },
	/* bits and bytes of a number */
	{ "NO Level.1_", "Level.1 Level.10 Level.11 Level.12 Level.13 Level.14 Level.15" },
	{ "NO Level.%x1_", "Level.%X1 Level.%X10 Level.%X11 Level.%X12 Level.%X13 Level.%X14 Level.%X15" },
	{ ">COIL Level.%_", "Level.%X0 Level.%X1 Level.%X2 Level.%X3 Level.%X4 Level.%X5 Level.%X6 Level.%X7 Level.%X8" },
	{ "NO Heat._", "" }, { "[ Level.%B_ ]", "Level.%B0 Level.%B1" }, { ">%MW4.15_", "%MW4.15" },
	{ "JMP _", "Top" }, { "CALL A_", "Alarm" },
	{ "NO I0.0_", "Start" }, { "NO %IX0.0_", "Start" }, { "NO %IX0_", "Start Stop %IX0.7" },
	{ "Level > L_", "Level LEN( LIMIT( LITTLE_ENDIAN_TO( LN( LOG( Full new:L@ new:L@%IW2 new:L@%MW2" },
	{ "Heat > SQ_", "SQRT( new:SQ@ new:SQ@%ID4 new:SQ@%MD4" },
	{ "[ SQ_ ]", "SQRT( new:SQ@%IX0.2 new:SQ@%MX0.1 new:SQ@" },
	{ "[ Level + AB_", "ABS( new:AB@ new:AB@%IW2 new:AB@%MW2" },
	{ "Level := INT_TO_RE_", "INT_TO_REAL( new:INT_TO_RE@ new:INT_TO_RE@%IW2 new:INT_TO_RE@%MW2" },
	{ "Level > LE_", "Level LEN( new:LE@ new:LE@%IW2 new:LE@%MW2" },
	/* only values of a type that fits */
	{ "Total := Total + 1_", "" }, { "Level := Level + 1_", "" },
	{ "Total := Total + h_", "Heat HOUR_OF( new:h@ new:h@%IW2 new:h@%MW2" },
	{ "Heat := Le_", "Level LEN( new:Le@ new:Le@%ID4 new:Le@%MD4" },
	{ "Wait := Wa_", "Wait new:Wa@ new:Wa@%IL8 new:Wa@%ML8" },
	{ "Wait > Fa_", "new:Fa@ new:Fa@%IL8 new:Fa@%ML8" },
	{ "Start AND Fa_", "Fan FanDelay new:Fa@%IX0.2 new:Fa@%MX0.1 new:Fa@" },
	{ "Level > 5 AND Le_", "LE( Level LEFT( LEN( LETTER_NUMBER( LETTER_OF( new:Le@%IX0.2 new:Le@%MX0.1 new:Le@" },
	{ "NO SQ_", "new:SQ@%IX0.2 new:SQ@%MX0.1 new:SQ@" },
	{ "Level := Fu_", "Full new:Fu@ new:Fu@%IW2 new:Fu@%MW2" },
	{ "tonr_", "TONR" }, { "xic_", "XIC" },
	{ "NO Start_", "Start" },
	/* declarations of a new name */
	{ "/Gate_", "new:Gate@%IX0.2 new:Gate@%MX0.1 new:Gate@" },
	{ "Open AT_", "new:Open@%IX0.2 new:Open@%MX0.1 new:Open@" },
	{ "Open AT _", "new:Open@%IX0.2 new:Open@%MX0.1 new:Open@" },
	{ "Open %_", "new:Open@%IX0.2 new:Open@%MX0.1" },
	{ "XIC Open AT %m_", "new:Open@%MX0.1" }, { ">/Lamp %q_", "new:Lamp@%QX0.3" },
	{ "Open AT %IX0.5_", "" }, { "Open AT %IX0.5 : _", "new:Open@%IX0.5" },
	{ "Open :_", "new:Open@" }, { "-(S)- Lamp : bo_", "new:Lamp@" }, { "Open : I_", "" },
	{ "Gate_ %IX0.5", "new:Gate@%IX0.5" },
	{ "TON T1 Later AT _", "new:Later@ new:Later@%IL8 new:Later@%ML8" },
	{ "TON T1 PT:=Later AT %m_", "new:Later@%ML8" },
	{ "TON T1 Later : _", "new:Later@" }, { "TON T1 Later : I_", "" },
	{ "Temp_ > 5", "new:Temp@ new:Temp@%IW2 new:Temp@%MW2" },
	{ "Temp AT %i_ > 5", "new:Temp@%IW2" },
	{ "Temp AT %IW6 : D_ > 5", "" }, { "Temp AT %IW6 : I_ > 5", "new:Temp@%IW6" },
	{ "Temp : L_ > 5", "new:Temp@ new:Temp@ new:Temp@" },
	{ "Sum AT %m_ := 5", "new:Sum@%MW2" }, { "Sum : RE_ := 5.5", "new:Sum@" },
	{ "Sum : REAL := SQ_", "SQRT( new:SQ@ new:SQ@%ID4 new:SQ@%MD4" },
	{ "Level > 5 AND Op_", "Stop new:Op@%IX0.2 new:Op@%MX0.1 new:Op@" },
	{ "Open AT I:0/5 : b_", "new:Open@%IX0.5" }, { "Start %_", "" }, { "Motor : _", "" },
};

/* A row for a new name shows what its line declares. */
static void check_row(const struct entry_place *place, const struct entry_candidate *row)
{
	struct entry entry;
	bool told = false;

	if (!entry_read(place, row->line, &entry)) /* an incomplete expression */
		return;
	for (int i = 0; i < entry.declares; i++)
		told |= !strcmp(entry.declare[i].name, row->text) &&
			!strcmp(entry.declare[i].address, row->address);
	if (!CHECK_AS(told, row->line))
		printf("# does not declare %s AT %s\n", row->text, row->address);
}

static void list(const struct entry_place *place, const char *line, char *out,
		 size_t size)
{
	static struct entry_candidate found[12];
	char copy[100];
	const char *cursor = strrchr(line, '_');
	const size_t at = (size_t)(cursor - line);
	int count, n = 0;

	snprintf(copy, sizeof(copy), "%.*s%s", (int)at, line, cursor + 1);
	count = entry_candidates(place, copy, at, found, 12);
	out[0] = '\0';
	for (int i = 0; i < count; i++) {
		const bool new = found[i].kind == ENTRY_NEW;

		if (new)
			check_row(place, &found[i]);
		n += snprintf(out + n, size - (size_t)n, "%s%s%s%s%s", i ? " " : "",
			      new ? "new:" : "", found[i].text, new ? "@" : "",
			      new ? found[i].address : "");
	}
}

static void check_offers(struct entry_place *place)
{
	for (size_t i = 0; i < sizeof(offered) / sizeof(*offered); i++) {
		const char *line = offered[i].line;
		char got[4000];

		place->output = line[0] == '>';
		list(place, line + place->output, got, sizeof(got));
		if (!CHECK_AS(!strcmp(got, offered[i].offers), line))
			printf("# got:  %s\n# want: %s\n", got, offered[i].offers);
	}
	place->output = false;
}

/* Where a block is wanted, the first candidates are function blocks, not variables. */
static void check_box_first(struct entry_place *place)
{
	static struct entry_candidate found[12];
	int count, blocks = 0;

	place->box = true;
	count = entry_candidates(place, "", 0, found, 12);
	while (blocks < count && found[blocks].kind == ENTRY_WORD &&
	       words_row(&place->project->words,
			 words_find(&place->project->words, found[blocks].text,
				    strlen(found[blocks].text)))->kind == WORD_FB)
		blocks++;
	CHECK(blocks > 5);
	count = entry_candidates(place, "Fan", 3, found, 12);
	CHECK(count > 0 && strcmp(found[0].text, "Fan") == 0);
	place->box = false;
}

/* The page of the documentation has all mnemonics. */
static void check_page(void)
{
	static char page[20000];
	FILE *file = fopen("docs/quick-entry.md", "r");
	const struct entry_mnemonic *m;
	int missing = 0;

	if (!CHECK(file != NULL))
		return;
	page[fread(page, 1, sizeof(page) - 1, file)] = '\0';
	fclose(file);
	for (int i = 0; (m = entry_mnemonic(i)) != NULL; i++) {
		char quoted[20];

		snprintf(quoted, sizeof(quoted), "`%s`", m->text);
		if (!strstr(page, quoted)) {
			printf("# not told of: %s\n", m->text);
			missing++;
		}
	}
	CHECK(missing == 0);
}

/* ---- any line at all ---- */

static uint64_t state = 88172645463325252u;

static int roll(int count)
{
	state ^= state << 13;
	state ^= state >> 7;
	state ^= state << 17;
	return (int)(state >> 33) % count;
}

static void make_line(char *out, size_t size)
{
	static const char *const parts[] = {
		"Start", "Motor", "Level", "FanDelay", "Fresh", "Lamps", "P1", "i", "Heat",
		"TON", "CTU", "ADD", "MOVE", "NO", "XIC", "OR", "COIL", "=", "JMP", "CALL",
		"FOR", "RET", "NOT", "AND", "[", "]", "(", ")", ":=", "=>", ">", "<=", "+",
		"/", "!", "-", "-|/|-", ".", ".Q", ".On", "PT", "IN1", "OUT", ",", "5", "2.5s",
		"T#1s", "16#FF", "%IX0.0", "%MW4", "I0.1", "X7", "Y10", "I:0/3", "'text'",
		"\"", "%", ":", "AT", "BOOL", "_T1", "启", "\xff", "$", "(*", "//", "|", "^", "DIV", "MUX",
	};
	size_t n = 0;

	out[0] = '\0';
	for (int count = 1 + roll(7); count > 0 && n + 1 < size; count--)
		n += (size_t)snprintf(out + n, size - n, "%s%s",
				      parts[roll((int)(sizeof(parts) / sizeof(*parts)))],
				      roll(3) ? " " : "");
}

/* The error in a result; NULL: none. */
static const char *judge(const struct entry_place *place, const struct entry *e)
{
	struct diag_list diags;
	struct rung *rung;
	struct cell cell;
	char text[2400], again[2400];
	const char *wrong = NULL;

	if (e->sense == ENTRY_WRONG && !e->why)
		return "the line is wrong and has no reason";
	if (e->sense != ENTRY_ELEMENT)
		return e->declares ? "the line declares a name and gives no element" : NULL;
	for (int i = 0; i < e->declares; i++)
		if (ladder_name_fault(e->declare[i].name) != DIAG_COUNT ||
		    entry_var_find(place, e->declare[i].name,
				   strlen(e->declare[i].name), NULL))
			return "the line declares a known or an invalid name";
	if (!entry_cell(place->project, e, &cell))
		return "the line gives no cell";
	text_write_cell(place->project, &cell, again, sizeof(again));
	snprintf(text, sizeof(text), "RUNG\n| %.2300s |\n", again);
	diag_init(&diags);
	rung = text_read_rung(place->project, text, strlen(text), &diags);
	if (!rung || diags.errors || rung->cell[0].word != cell.word ||
	    rung->cell[0].operand != cell.operand || rung->cell[0].args != cell.args)
		wrong = "the written cell is not read as the same cell";
	rung_free(rung);
	return wrong;
}

static void check_any(struct entry_place *place)
{
	static struct entry_candidate found[8];
	const char *wrong = NULL;
	int elements = 0;

	for (int i = 0; i < 20000 && !wrong; i++) {
		struct entry entry;
		char line[400];
		int count;

		make_line(line, sizeof(line));
		place->output = roll(3) == 0;
		entry_read(place, line, &entry);
		elements += entry.sense == ENTRY_ELEMENT;
		wrong = judge(place, &entry);
		if (i % 10 == 0) {
			count = entry_candidates(place, line,
						 (size_t)roll((int)strlen(line) + 2), found,
						 1 + roll(8));
			for (int k = 0; k + 1 < count; k++)
				if (found[k].kind == ENTRY_NEW &&
				    found[k + 1].kind != ENTRY_NEW)
					wrong = "a new name is offered before another candidate";
		}
		if (wrong)
			printf("# %s: %s\n", line, wrong);
	}
	printf("# %d of them are elements\n", elements);
	CHECK(!wrong);
	CHECK(elements > 1000);
	place->output = false;
}

/* A rung and its copy, with the new declarations. */
static const struct { const char *rung, *twice; } rungs[] = {
	{ "| NO Start | TON FanDelay PT:=T#5s | COIL Motor |",
	  "| NO Start | TON FanDelay1 PT:=T#5s | COIL Motor | + FanDelay1 TON" },
	{ "| NO FanDelay.Q | [ FanDelay.ET > T#1s ] | TON fandelay PT:=FanDelay.ET | COIL Fan |",
	  "| NO FanDelay1.Q | [ FanDelay1.ET > T#1s ] | TON FanDelay1 PT:=FanDelay1.ET | "
	  "COIL Fan | + FanDelay1 TON" },
	{ "| NO FanDelay.Q | COIL Motor |", "| NO FanDelay.Q | COIL Motor |" },
	{ "| NO Start | COIL FanDelays |", "| NO Start | COIL FanDelays |" },
};

static void check_duplicates(const struct entry_place *place)
{
	struct project *project = place->project;

	for (size_t i = 0; i < sizeof(rungs) / sizeof(*rungs); i++) {
		struct entry_instance *made = NULL;
		struct diag_list diags;
		struct rung *rung, *copy;
		char text[400], got[800] = "";
		int count = 0;

		diag_init(&diags);
		snprintf(text, sizeof(text), "RUNG\n%s\n", rungs[i].rung);
		rung = text_read_rung(project, text, strlen(text), &diags);
		copy = rung;
		if (!CHECK(rung && entry_duplicate(place, &copy, 1, &made, &count)))
			continue;
		for (int k = 0; copy && k < copy->cols; k++) {
			text_write_cell(project, &copy->cell[k], text, sizeof(text));
			snprintf(got + strlen(got), sizeof(got) - strlen(got), "| %s ", text);
		}
		snprintf(got + strlen(got), sizeof(got) - strlen(got), "|");
		for (int k = 0; k < count; k++)
			snprintf(got + strlen(got), sizeof(got) - strlen(got), " + %s %s",
				 project_text(project, made[k].to),
				 words_row(&project->words, made[k].word)->word);
		if (!CHECK_AS(!strcmp(got, rungs[i].twice), rungs[i].rung))
			printf("# got: %s\n", got);
		rung_free(rung);
		rung_free(copy);
		free(made);
	}
}

/* A step's X and T are known; 5s is a time. A step may have the name of a variable. */
static void check_conditions(void)
{
	static const char chart[] =
		"RUNGBOARD 1\nVAR\nHeat AT %IX0.0 : BOOL;\nWait : TIME;\nEND_VAR\n"
		"PROGRAM Way SFC\nINITIAL_STEP Boil:\nEND_STEP\nSTEP Heat:\nEND_STEP\nSTEP Step7:\nEND_STEP\n"
		"TRANSITION FROM Boil TO Heat := Heat; END_TRANSITION\n"
		"TRANSITION FROM Heat TO Boil := TRUE; END_TRANSITION\nEND_PROGRAM\n";
	static const struct { const char *line, *means; } cases[] = {
		{ "Heat.T > 5s", "Heat.T > T#5s" }, { "heat.t>=1m30s", "heat.t >= T#1m30s" },
		{ "Wait < 2.5s", "Wait < T#2.5s" }, { "Wait < T#5s", "Wait < T#5s" },
		{ "NOT Boil.X", "NOT Boil.X" }, { "Boil.X AND Heat", "Boil.X AND Heat" },
		{ "%X7.A", "Step7.X" }, { "Heat AND %X7.V > 5s", "Heat AND Step7.T > T#5s" },
		{ "%B3 AND X1", "%MX0.3 AND %IX0.1" }, { "%MX0.3 AND E4.0", "%MX0.3 AND %IX4.0" },
	};
	struct ladder *ladder = ladder_new();
	struct entry_place place = { 0 };
	struct entry *entry = calloc(1, sizeof(*entry));

	if (!CHECK(entry && ladder_load_text(ladder, "chart", chart, strlen(chart))))
		return;
	place.project = ladder_project(ladder);
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		CHECK_AS(entry_condition(&place, cases[i].line, entry), cases[i].line);
		CHECK_TEXT(entry->operand, cases[i].means);
		CHECK_AS(entry->declares == 0, cases[i].line);
	}
	CHECK(!entry_condition(&place, "Boil.Z", entry) && entry->sense == ENTRY_WRONG);
	CHECK(!entry_condition(&place, "NOT", entry) && entry->sense == ENTRY_PART);
	CHECK(!entry_condition(&place, "Boil.", entry) && entry->sense == ENTRY_PART);
	free(entry);
	ladder_free(ladder);
}

/* The family of a word and what it does are two texts; the type of a variable has its comment. */
static void check_notes(const struct entry_place *place)
{
	static struct entry_candidate found[12];
	const int count = entry_candidates(place, "TON", 3, found, 12);
	const char *note = NULL;

	for (int i = 0; i < count && !note; i++)
		if (found[i].kind == ENTRY_WORD && !strcmp(found[i].text, "TON"))
			note = found[i].note;
	CHECK_TEXT(note ? note : "", "Timers · on-delay timer");
}

/* A line has room with its end, or is refused: none is cut. */
static void check_length(const struct entry_place *place)
{
	static struct entry entry;
	char line[ENTRY_TEXT + 2];

	for (size_t len = ENTRY_TEXT - 2; len <= ENTRY_TEXT + 1; len++) {
		memset(line, 'x', len);
		line[len] = '\0';
		entry_read(place, line, &entry);
		CHECK_AS((entry.why && strcmp(entry.why, "the line is too long") == 0) ==
			 (len >= ENTRY_TEXT),
			 "a line of ENTRY_TEXT bytes has no room for its end");
	}
}

/* The part that is wrong stands in brackets; behind it, what may stand there. */
static void check_wrong_parts(const struct entry_place *place)
{
	static const struct { const char *line, *says; } cases[] = {
		{ "%IX0.9", "%IX0.[9] the bits of a byte are 0 to 7" },
		{ ">%QX0.8", "%QX0.[8] the bits of a byte are 0 to 7" },
		{ "I0.9", "I0.[9] the bits of a byte are 0 to 7" },
		{ "Level > 5 AND %MX0.8", "%MX0.[8] the bits of a byte are 0 to 7" },
		{ "%MW2.16", "%MW2.[16] its bits are 0 to 15" },
		{ "%md2.32", "%md2.[32] its bits are 0 to 31" },
		{ "%IX99999.0", "%IX[99999].0 of this project: its area ends at byte 511" },
		{ "Level > %MD8190", "%MD[8190] of this project: its area ends at byte 8191" },
		{ "%KX0.0", "%[KX]0.0 the areas are I, Q, M, V, S, SM, AI, AQ, XI, XQ, XAI, XAQ" },
		{ "%", "%[] the areas are I, Q, M, V, S, SM, AI, AQ, XI, XQ, XAI, XAQ" },
		{ "%IZ0.1", "%I[Z0.1] behind the area stand X, B, W, D or L, and a number" },
		{ "%QX", "[%QX] behind the area stand X, B, W, D or L, and a number" },
		{ "Lamp %IX0.9 : BOOL", "%IX0.[9] the bits of a byte are 0 to 7" },
		{ "2Fast", "[2Fast]" }, { "Gone.Q", "[Gone.Q]" }, { "Level", "[Level]" },
		{ "Start %IX0.3", "[Start]" }, { "NO Wait.Frob", "[Wait.Frob]" },
	};
	struct entry_place at = *place;
	struct entry entry;
	char said[400];

	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		const char *line = cases[i].line;
		const char *why;

		at.output = *line == '>';
		entry_read(&at, line + at.output, &entry);
		why = entry.why ? strstr(entry.why, "address") : NULL;
		snprintf(said, sizeof(said), "%.*s[%.*s]%s", (int)entry.wrong_at, entry.wrong, (int)entry.wrong_len,
			 entry.wrong + entry.wrong_at, entry.wrong + entry.wrong_at + entry.wrong_len);
		if (strchr(cases[i].says, ' ') && why) {
			const size_t used = strlen(said);

			snprintf(said + used, sizeof(said) - used, why + strlen(why + 7 == strstr(why, ": ") ? "address:" : "address"),
				 entry.instead);
		}
		if (!CHECK(entry.sense == ENTRY_WRONG && strcmp(said, cases[i].says) == 0))
			printf("# %s: %s\n", line, said);
	}
}

int main(int argc, char **argv)
{
	struct ladder *ladder = ladder_new();
	struct entry_place place = { 0 };

	if (argc > 1)
		state = strtoull(argv[1], NULL, 10);
	if (!CHECK(ladder && ladder_load_text(ladder, "test", project_text_,
					      strlen(project_text_))))
		return tap_done();
	place.project = ladder_project(ladder);
	for (int i = 0; i < place.project->pou_count; i++)
		if (!strcmp(project_text(place.project, place.project->pou[i].name), "Main"))
			place.pou = i;
	check_lines(&place);
	check_wrong_parts(&place);
	check_offers(&place);
	check_box_first(&place);
	check_notes(&place);
	check_duplicates(&place);
	check_conditions();
	check_any(&place);
	check_length(&place);
	check_page();
	ladder_free(ladder);
	return tap_done();
}
