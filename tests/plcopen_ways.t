#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# plcopen_ways.t - what PLCopen XML has a way of its own for: labels, actions, calls with EN, lines of Structured Text in
# a box, and the way in which CODESYS and TwinCAT write a whole application. Each project here is exported, loses the
# text beside the drawing, and does the same after the import.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;
use PlcopenShape;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
chdir $folder or die;

spew('probe.xml', '<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types/></project>');
plan skip_all => 'built without libxml2' if `$ladder check probe.xml 2>&1` =~ /LD040/;

sub bare { return $_[0] =~ s{  <addData>\n    <data name="urn:rungboard:text".*?</addData>\n}{}sr }

# Exports, imports from the drawing alone, and compares what both do. Returns the rung file and the report of the export.
sub both_ways {
	my ($name, $file, $script) = @_;
	my $said = `$ladder export --as plcopen $file -o $name.xml 2>&1`;
	is($?, 0, "$name: exported") or diag($said);
	is(PlcopenShape::wrong(slurp("$name.xml")), '', "$name: as TC6 2.01 has it");
	spew('bare.xml', bare(slurp("$name.xml")));
	my $report = `$ladder import bare.xml -o $name.back.rung 2>&1`;
	is($?, 0, "$name: imported") or diag($report);
	spew('script', $script);
	my ($was, $is) = map { scalar `$ladder trace $_ script 2>trouble` } $file, "$name.back.rung";
	like($was, qr/^1 t=/, "$name: it runs");
	is($is, $was, "$name: the drawing alone does the same") or diag($report . slurp("$name.back.rung"));
	system("$ladder import $name.xml -o $name.own.rung >trouble 2>&1");
	return (slurp("$name.back.rung"), $said, slurp("$name.own.rung"));
}

# ---- labels ----
spew('labels.rung', <<'END');
RUNGBOARD 1

VAR
  Go   AT %IX0.0 : BOOL;
  Q    AT %QX0.0 : BOOL;
  N    : INT;
END_VAR

PROGRAM Networks FBD
NETWORK
  N := N + 1
  JMP Last IF Go
NETWORK OFF Middle
  N := 0
NETWORK
  JMP Middle IF N = 5
NETWORK
  Q := N > 3
NETWORK First
NETWORK Last
END_PROGRAM

PROGRAM Rungs LD
RUNG
  | NO Go | JMP Over |
RUNG OFF Away
  | NO Go | COIL Q |
RUNG
  | [ N > 7 ] | [ N := 1 ] |
RUNG Nothing
RUNG Over
END_PROGRAM
END
my ($labels) = both_ways('labels', 'labels.rung', "\@print N Q\n" . "Go=0\n" x 4 . "Go=1\n. x3\nGo=0\n. x4\n");
is(join(' ', $labels =~ /^(?:NETWORK|RUNG) (\w+)/mg), 'Middle First Last Away Nothing Over', 'each label is there again');

# ---- a call with EN stores its outputs only if it runs ----
spew('enable.rung', <<'END');
RUNGBOARD 1

VAR
  Go AT %IX0.0 : BOOL;
  X  AT %IX0.1 : BOOL;
  Q  AT %QX0.0 : BOOL;
  N  AT %QW8 : INT;
  M  AT %QW10 : INT;
END_VAR

FUNCTION Twice : INT ST
VAR_INPUT
  A : INT;
END_VAR
VAR_OUTPUT
  More : INT;
END_VAR
  More := A + 1;
  Twice := A * 2;
END_FUNCTION

FUNCTION_BLOCK Plus ST
VAR_INPUT
  A : INT;
END_VAR
VAR_OUTPUT
  B : INT;
  C : BOOL;
END_VAR
  B := A + 1;
  C := A > 3;
END_FUNCTION_BLOCK

PROGRAM Main FBD
VAR
  Delay : TON;
  One   : Plus;
  K     : INT;
END_VAR
NETWORK
  K := K + 1
  Delay(EN := NOT Go, IN := X, PT := T#20ms, Q => Q)
NETWORK
  N := Twice(EN := Go, A := K, More => M)
NETWORK
  One(EN := R_EDGE(X), A := K, B => K, C => Q)
END_PROGRAM
END
both_ways('enable', 'enable.rung', "\@print Q N M Main.K\n. x2\nGo=1 X=1\n. x5\nQ=1 Go=0\n. x3\nX=0\nQ=0\nX=1\nGo=1\n. x3\nMain.K=40\nX=0 Q=1\nX=1\n");

# ---- EN reads what the outputs store ----
spew('kept.rung', <<'END');
RUNGBOARD 1

VAR
  Set AT %IX0.1 : BOOL;
  M   AT %MX0.0 : BOOL;
  L   : ARRAY[0..3] OF BOOL;
  N   AT %QW2 : INT;
  O   AT %QW4 : INT;
  P   AT %QW6 : INT;
  S   AT %QW8 : INT;
END_VAR

FUNCTION_BLOCK Plus ST
VAR_INPUT
  A : INT;
END_VAR
VAR_OUTPUT
  C : BOOL;
  B : INT;
  D : BOOL := TRUE;
END_VAR
  B := A + 1;
  C := FALSE;
  D := NOT D;
END_FUNCTION_BLOCK

PROGRAM Main FBD
VAR
  One, Two, Three, Four : Plus;
  K : INT;
END_VAR
NETWORK
  K := K + 1
  M S= Set
  L[1] S= Set
  L[2] S= Set
NETWORK
  Two(EN := L[1] AND M, A := K, C => L[1], B => O)
NETWORK
  One(EN := M, A := K, C => M, B => N)
NETWORK
  Three(EN := Three.D, A := K, B => P)
NETWORK
  Four(EN := R_EDGE(L[2]), A := K, C => L[2], B => S)
NETWORK
  L[1] := Set
END_PROGRAM
END
both_ways('kept', 'kept.rung', "\@print M N O P S L[1]\n.\nSet=1\nSet=0\n. x2\nSet=1\n. x2\nSet=0\nM=1\n. x2\nM=0\nSet=1\n");

# ---- actions of POUs that are no charts, called from ladders, networks and text ----
spew('actions.rung', <<'END');
RUNGBOARD 1

VAR
  Up AT %IX0.0 : BOOL;
  Q  AT %QX0.0 : BOOL;
  N  AT %QW2   : INT;
END_VAR

FUNCTION_BLOCK Count LD
VAR_INPUT
  By : BOOL;
END_VAR
VAR_OUTPUT
  Sum : INT;
END_VAR
RUNG
  | NO By | CALL More |
END_FUNCTION_BLOCK

(* One more *)
ACTION More:
  Sum := Sum + 1;
END_ACTION

ACTION Less:
NETWORK
  Sum := SUB(Sum, 1)
END_ACTION

PROGRAM Main ST
VAR
  One    : Count;
  Action : INT;
END_VAR
  One(By := Up, Sum => N);
  Action := N;
  IF NOT Up THEN
    Show();
    One.Less();
  END_IF;
  Other.Tell();
END_PROGRAM

ACTION Show:
RUNG
  | [ Action > 2 ] | COIL Q |
END_ACTION

PROGRAM Other FBD
VAR
  Told : INT;
END_VAR
NETWORK
  Tell()
END_PROGRAM

ACTION Tell:
  Told := Told + 1;
END_ACTION
END
my ($actions, $told, $own) = both_ways('actions', 'actions.rung', "\@print Q N Other.Told\nUp=1\n. x5\nUp=0\n. x3\nUp=1\n. x9\n");
is(join(' ', slurp('actions.xml') =~ /<action name="(\w+)"/g), 'More Less Show Tell', 'they stand where the schema has them');
is($told, '', 'and nothing is lost');
is($own, slurp('actions.rung'), 'with the text beside the drawing the file is the same');
like($actions, qr/^\(\* One more \*\)\nACTION More:/m, 'comments stay');

# ---- a box EXECUTE, as CODESYS and TwinCAT have it ----
spew('execute.rung', <<'END');
RUNGBOARD 1

VAR
  Go    AT %IX0.0 : BOOL;
  Raw   AT %IW2   : INT;
  Ready AT %QX0.0 : BOOL;
  Next  : INT := 1;
  Mean  : INT;
END_VAR

PROGRAM Main LD
VAR
  i : INT;
END_VAR
RUNG
  | NO Go | EXECUTE Mean | COIL Ready |
  EXECUTE Mean:
    Next := Next MOD 4 + 1;
    IF Next < 3 AND Raw <> 0 THEN
      Mean := 0;
    END_IF;
    FOR i := 1 TO 4 DO
      Mean := Mean + Raw / 4;
    END_FOR;
  END_EXECUTE
RUNG
  | [ Mean > 300 ] | EXECUTE |
  EXECUTE:
    Mean := Mean - 1;
  END_EXECUTE
RUNG
  | NO Go | [ Mean := Mean + Next ] |
END_PROGRAM
END
(my $execute, $told) = both_ways('execute', 'execute.rung', "\@print Ready Mean Next\n%IW2=400\nGo=1\n. x3\n%IW2=800\nGo=0\n. x3\nGo=1\n");
is($told, '', 'an EXECUTE is not lost');
is(scalar(() = $execute =~ /^  END_EXECUTE/mg), 2, 'both boxes are boxes again');

# ---- a connection with a block tells its output and its two ends, also if the block stands further down ----
spew('below.rung', <<'END');
RUNGBOARD 1
VAR
  A AT %IX0.0 : BOOL;
  B AT %IX0.1 : BOOL;
  Q AT %QX0.0 : BOOL;
  N AT %IW2 : INT;
  D : TON;
END_VAR
PROGRAM Main LD
RUNG
  | NO A | NC B | COIL Q |
  | NO B | EQ IN1:=N IN2:=3 ^|
RUNG
  | NO A | --- | S Q |
  | NO B | TON D PT:=T#20ms ^|
END_PROGRAM
END
both_ways('below', 'below.rung', "\@print Q D.ET\nA=1\nA=0 B=1\n%IW2=3\n%IW2=4\nB=0\n%IW2=3\nB=1\n.\n. x3\nQ=0\n");
{
	my $xml = slurp('below.xml');
	my %block = map { $_ => 1 } $xml =~ /<block localId="(\d+)"/g;
	my @bare = grep { $block{$_} } $xml =~ /<connection refLocalId="(\d+)">/g;
	is("@bare", '', 'an output of a block is named');
	is(scalar(() = $xml =~ m{<connection [^>]*>\s*<position [^>]*/>\s*<position [^>]*/>\s*</connection>}g), scalar(() = $xml =~ /<connection /g), 'each connection has its ends');
}

# ---- plain text comes back as it is ----
spew('plain.st', <<'END');
(* A plain file *)
TYPE
  Color : (Red, Green);
END_TYPE

FUNCTION_BLOCK Counter
VAR_INPUT
  Up : BOOL;
END_VAR
VAR_OUTPUT
  N : INT;
END_VAR
  IF Up THEN
    Add();
  END_IF;
END_FUNCTION_BLOCK

ACTION Add:
  N := N + 1;
END_ACTION

PROGRAM Main
VAR
  c : Counter;
  s : STRING := ']]>';
END_VAR
  c(Up := TRUE);
  s := '&amp;';
END_PROGRAM
END
(undef, undef, $own) = both_ways('plain', 'plain.st', "\@print Main.c.N Main.s\n. x4\n");
is($own, slurp('plain.st'), 'plain text: the same bytes');
spew('changed.xml', slurp('plain.xml') =~ s/N := N \+ 1/N := N + 2/r);
is(`$ladder import changed.xml -o changed.rung >trouble 2>&1; echo \$?`, "0\n", 'a changed one is read from the XML');
like(slurp('changed.rung'), qr/^RUNGBOARD 1.*N := N \+ 2/s, 'and says what it says there');

# A rung file that names a plain one.
spew('part.st', slurp('plain.st') =~ s/^PROGRAM.*//msr);
spew('names.rung', qq(RUNGBOARD 1\nINCLUDE "part.st"\n\nPROGRAM Main ST\nVAR\n  c : Counter;\nEND_VAR\n  c(Up := TRUE);\nEND_PROGRAM\n));
(undef, undef, $own) = both_ways('names', 'names.rung', "\@print Main.c.N\n. x4\n");
like($own, qr/^ACTION Add:\n  N := N \+ 1;\nEND_ACTION/m, 'an action of a file that is included comes back');
is(`$ladder check names.own.rung 2>&1`, "names.own.rung: good\n", 'and is good');

# DWORD_TO_REAL of files of CODESYS keeps the number.
spew('numbers.EXP', <<'END');
(* @NESTEDCOMMENTS := 'Yes' *)
PROGRAM PLC_PRG
VAR
	d AT %ID0 : DWORD;
	r : REAL;
	w AT %QD0 : DWORD;
END_VAR
r := DWORD_TO_REAL(d); (* DWORD_TO_REAL *)
w := REAL_TO_DWORD(r);
END_PROGRAM
END
my ($numbers) = both_ways('numbers', 'numbers.EXP', "\@print PLC_PRG.r PLC_PRG.w\n%ID0=5\n");
like($numbers, qr/r := UDINT_TO_REAL\(d\);\s*\(\* DWORD_TO_REAL \*\)/, 'its words are those that say so here');

# ---- types with names of instructions and cells: they stay, as in a rung file; those of functions and blocks do not ----
my @words = qw(R S LD ST CAL N ANDN JMPC JMP RET NO NC COIL OTE XIC);
sub types_of { my ($text) = $_[0] =~ /^(TYPE\n.*?^END_TYPE\n)/ms; return $text }
sub words_project {
	return "RUNGBOARD 1\n\nTYPE\n" . join('', map { "  $_ : STRUCT\n    x : INT;\n  END_STRUCT;\n" } @_) . "END_TYPE\n\nPROGRAM Main IL\nVAR\n"
		. join('', map { "  v$_ : $_;\n" } @_) . "  b : BOOL;\n  c : BOOL;\nEND_VAR\n  LD b\n  R c\n" . join('', map { "  LD v$_.x\n  ADD 1\n  ST v$_.x\n" } @_) . "END_PROGRAM\n";
}
my @may = grep { spew('word.rung', words_project($_)); system("$ladder check word.rung >trouble 2>&1") == 0 } @words;
cmp_ok(scalar @may, '>=', 8, "types may be named @may");
spew('words.rung', words_project(@may));
my ($back) = both_ways('words', 'words.rung', '@print ' . join(' ', map { "Main.v$_.x" } @may) . "\n. x2\n");
is(types_of($back), types_of(slurp('words.rung')), 'words as types: they keep their names');
my ($again) = both_ways('words2', 'words.back.rung', '@print ' . join(' ', map { "Main.v$_.x" } @may) . "\n. x2\n");
is($again, $back, 'words as types: and once more');
for my $word (@may, 'TON', 'ADD', 'LIMIT') {
	spew('word.xml', slurp('bare.xml') =~ s/"$may[0]"/"$word"/gr =~ s/(<dataType name="$word">.*?<\/dataType>)(.*)<dataType name="$word">.*?<\/dataType>/$1$2/sr);
	my $said = `$ladder import word.xml -o word.rung 2>&1`;
	my $is = grep({ $_ eq $word } @may) ? $word : "${word}_1";
	like(slurp('word.rung'), qr/^  $is : STRUCT\n/m, "a type $word becomes $is") or diag($said);
}

# ---- an application of CODESYS or TwinCAT: all of it stands in data behind the project ----
my $three = 'http://www.3s-software.com/plcopenxml';
sub data { return qq(<data name="$three/$_[0]" handleUnknown="implementation">$_[1]</data>\n) }
sub st { return "<body><ST><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">$_[0]</xhtml></ST></body>" }
sub set { return '<addData>' . data('sfc/element', '<attributes xmlns="">' . join('', map { "<attribute guid=\"$_->[0]\">$_->[1]</attribute>" } @_) . '</attributes>') . '</addData>' }
my ($main, $entry, $exit, $named) = qw(700a583f-b4d4-43e4-8c14-629c7cd3bec8 a6b08bd8-b696-47e3-9cbf-7408b61c9ff8 a2621e18-7de3-4ea6-ae6d-89e9e0b7befd 38391c6d-6d4a-42f8-8ee7-9f45e5adafa8);
my $place = '<position x="0" y="0"/>';
my $variables = sub { join '', map { my ($name, $type) = split /:/; "<variable name=\"$name\"><type>" . ($type =~ /^[A-Z]+$/ ? "<$type/>" : "<derived name=\"$type\"/>") . '</type></variable>' } @_ };
my $chart = <<"END";
<pou name="Chart" pouType="functionBlock"><interface><localVars>@{[$variables->('Way:BOOL', 'Sum:INT', 'Ins:INT', 'Outs:INT', 'Drive:Motor')]}</localVars></interface>
<actions><action name="Add">@{[st('Sum := Sum + 1;')]}</action><action name="In">@{[st('Ins := Ins + 1;')]}</action>
<action name="Inner"><body><SFC><step localId="0" initialStep="true" name="S">$place<connectionPointOut formalParameter="sfc"/></step></SFC></body></action></actions>
<body><SFC>
<step localId="0" initialStep="true" name="Rest">$place<connectionPointIn/><connectionPointOut formalParameter="sfc"/>@{[set([$named, 'Rest'], [$main, 'Add'])]}</step>
<inVariable localId="1">$place<connectionPointOut/><expression>GVL.Go</expression></inVariable>
<transition localId="2">$place<connectionPointIn><connection refLocalId="0" formalParameter="sfc"/></connectionPointIn><condition><connectionPointIn><connection refLocalId="1"/></connectionPointIn></condition></transition>
<step localId="3" name="Work">$place<connectionPointIn><connection refLocalId="2"/></connectionPointIn><connectionPointOut formalParameter="sfc"/>@{[set([$named, 'Work'], [$main, 'Drive.Turn'], [$entry, 'In'], [$exit, 'In'])]}</step>
<inVariable localId="4">$place<connectionPointOut/><expression>NOT GVL.Go</expression></inVariable>
<transition localId="5">$place<connectionPointIn><connection refLocalId="3" formalParameter="sfc"/></connectionPointIn><condition><connectionPointIn><connection refLocalId="4"/></connectionPointIn></condition></transition>
<jumpStep localId="6" targetName="Rest">$place<connectionPointIn><connection refLocalId="5"/></connectionPointIn></jumpStep>
</SFC></body></pou>
END
my $motor = "<pou name=\"Motor\" pouType=\"functionBlock\"><interface><outputVars>" . $variables->('Turns:INT') . "</outputVars></interface><actions><action name=\"Turn\">" . st('Turns := Turns + 1;') . '</action></actions>' . st('') . '</pou>';
my $title = sub { "<comment localId=\"$_[0]\" height=\"0\" width=\"0\">$place<content><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">$_[1]</xhtml></content></comment>\n<vendorElement localId=\"" . ($_[0] + 1)
	. "\">$place<alternativeText><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">$_[2]</xhtml></alternativeText><addData>" . data('fbdelementtype', '<ElementType xmlns="">networktitle</ElementType>') . '</addData></vendorElement>' };
my $ladder_body = <<"END";
<pou name="MAIN" pouType="program"><interface><localVars>@{[$variables->('One:Chart', 'A:BOOL', 'B:BOOL', 'N:INT', 'M:INT')]}</localVars></interface>
<actions><action name="Count">@{[st('M := M + 1;')]}</action></actions>
<body><LD><leftPowerRail localId="0">$place<connectionPointOut formalParameter="none"/></leftPowerRail>
@{[$title->(1, 'why one', 'The first')]}
<contact localId="3" negated="false" storage="none" edge="none">$place<connectionPointIn><connection refLocalId="0"/></connectionPointIn><connectionPointOut/><variable>GVL.Go</variable></contact>
<coil localId="4" negated="false" storage="none">$place<connectionPointIn><connection refLocalId="3"/></connectionPointIn><connectionPointOut/><variable>A</variable></coil>
@{[$title->(5, 'why two', 'The second')]}
<contact localId="8" negated="false" storage="none" edge="none">$place<connectionPointIn><connection refLocalId="0"/></connectionPointIn><connectionPointOut/><variable>A</variable></contact>
<block localId="7" typeName="EXECUTE">$place<inputVariables><variable formalParameter="EN"><connectionPointIn><connection refLocalId="8"/></connectionPointIn></variable></inputVariables><inOutVariables/>
<outputVariables><variable formalParameter="ENO"><connectionPointOut/></variable></outputVariables><addData>@{[data('fbdcalltype', '<CallType xmlns="">execute</CallType>') . data('stcode', "<STCode xmlns=\"\">N := N + 1;\nOne();\nIF N &gt; 2 THEN\n B := TRUE;\nEND_IF</STCode>")]}</addData></block>
<block localId="10" typeName="Count">$place<inputVariables><variable formalParameter="EN"><connectionPointIn><connection refLocalId="7" formalParameter="ENO"/></connectionPointIn></variable></inputVariables><inOutVariables/>
<outputVariables><variable formalParameter="ENO"><connectionPointOut/></variable></outputVariables></block>
<rightPowerRail localId="2147483646">$place<connectionPointIn><connection refLocalId="10" formalParameter="ENO"/></connectionPointIn></rightPowerRail>
</LD></body></pou>
END
my $application = <<"END";
<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0200">
<fileHeader companyName="C" productName="P" productVersion="1" creationDateTime="2026-01-01T00:00:00"/>
<contentHeader name="All"><coordinateInfo><fbd><scaling x="1" y="1"/></fbd><ld><scaling x="1" y="1"/></ld><sfc><scaling x="1" y="1"/></sfc></coordinateInfo></contentHeader>
<types><dataTypes/><pous/></types><instances><configurations/></instances>
<addData>
@{[data('application', '<resource name="App"><task name="Often" interval="PT0S" priority="3"><pouInstance name="MAIN" typeName=""><documentation><xhtml xmlns="http://www.w3.org/1999/xhtml"/></documentation></pouInstance><addData>'
	. data('tasksettings', '<TaskSettings KindOfTask="Cyclic" Interval="500" IntervalUnit="us"><Watchdog Enabled="false"/></TaskSettings>') . '</addData></task>'
	. '<globalVars name="GVL">' . $variables->('Go:BOOL', 'Best:Kind') . '</globalVars><addData>' . data('pou', $ladder_body) . data('pou', $chart) . data('pou', $motor)
	. data('datatype', '<dataType name="Kind"><baseType><enum><values><value name="Small"/><value name="Big"/></values></enum></baseType></dataType>') . '</addData></resource>')]}
</addData></project>
END
spew('application.xml', $application);
my $report = `$ladder import application.xml -o application.rung 2>warnings`;
my $made = slurp('application.rung');
is($?, 0, 'an application: imported') or diag($report . slurp('warnings') . $made);
is(join('', grep { /: (?:lost|changed): / } $report =~ /^.*\n/mg), "application.xml:35: changed: the action Chart.Inner is a chart: it becomes the function block Chart_Inner, which the action calls\n", 'and nothing is lost')
	or diag($report);
like($made, qr/TASK Often \(INTERVAL := T#500us, PRIORITY := 3\);\n    PROGRAM MAIN WITH Often : MAIN;/, 'its task, as the settings say it');
like($made, qr/^NAMESPACE GVL\n\nVAR_GLOBAL\n  Go /m, 'a list whose name is said before its variables');
like($made, qr/^\(\* why one\s+The first \*\)\nRUNG\n.*GVL.Go.*\n\(\* why two\s+The second \*\)\nRUNG\n.*EXECUTE Box7 \| CALL Count/m, 'comments and titles stand above their rungs, a box has its lines');
like($made, qr/Add\(N\);.*Work_active\(N\);\n    In\(P1\);\n    In\(P0\);.*ACTION Work_active:\n    Drive\.Turn\(\);/s, 'what a step does while it is active, when it begins and when it ends');
spew('script', "\@print MAIN.A MAIN.B MAIN.N MAIN.M MAIN.One.Sum MAIN.One.Ins MAIN.One.Drive.Turns\n.\nGo=1\n. x3\nGVL.Go=0\n. x2\n");
is(`$ladder trace application.rung script 2>trouble`, '', 'it runs');

# An action of a chart that a text calls: another action of it, a step as well, and a program from outside.
(my $calling = $application) =~ s{Sum := Sum \+ 1;}{Sum := Sum + 1; More();};
$calling =~ s{(<action name="In">)}{'<action name="More">' . st('Outs := Outs + 10;') . "</action>$1"}e;
$calling =~ s{(<attribute guid="$main">Add</attribute>)}{$1<attribute guid="$entry">More</attribute>};
$calling =~ s{(?<=">)N := N \+ 1;}{N := N + 1; One.More();};
spew('calling.xml', $calling);
$report = `$ladder import calling.xml -o calling.rung 2>&1`;
is($?, 0, 'an action of a chart that others call: imported') or diag($report);
like(slurp('calling.rung'), qr/^END_FUNCTION_BLOCK\n\nACTION More:\n  Outs := Outs \+ 10;\nEND_ACTION\n/m, 'it stands behind the chart, which texts reach') or diag(slurp('calling.rung'));
spew('script', "\@print MAIN.One.Sum MAIN.One.Outs\n.\n. x3\nGo=1\n.\n");
like(join(' ', `$ladder trace calling.rung script 2>trouble` =~ /(?:Outs|Sum)=\d+/g), qr/Sum=1 Outs=30 Sum=2 Outs=50$/, 'and all of them call it') or diag(slurp('trouble') . slurp('calling.rung'));

# The places that the schema has may be there or not: what is made is the same, with a second application behind the first, too.
for my $second ('', data('application', '<resource name="App2"><addData>' . data('pou', '<pou name="Further" pouType="program"><interface/>' . st(';') . '</pou>') . data('datatype', '<dataType name="Many"><baseType><INT/></baseType></dataType>') . '</addData></resource>')
	. data('pou', '<pou name="Last" pouType="program"><interface/>' . st(';') . '</pou>')) {
	my $whole = $application =~ s{(</addData></project>)}{$second$1}r;
	my %made;
	for my $gone ('', '<types><dataTypes/><pous/></types>', '<instances><configurations/></instances>', '<types><dataTypes/><pous/></types><instances><configurations/></instances>', '<dataTypes/>', '<pous/>', '<configurations/>', '<dataTypes/><pous/>') {
		spew('places.xml', $gone ? $whole =~ s/\Q$gone\E//r : $whole);
		my $said = `$ladder import places.xml -o places.rung 2>&1`;
		is($?, 0, "an application without $gone: imported") or diag($said);
		$made{$gone} = slurp('places.rung');
		is($made{$gone}, $made{''}, "an application without $gone: the same");
	}
	like($made{''}, qr/^PROGRAM Further.*^PROGRAM Last/ms, 'all of the second one is there') if $second;
	like($made{''}, qr/^  Many +: INT;/m, 'its types as well') if $second;
}
spew('places.xml', $application =~ s{<types>.*</addData>(?=</project>)}{}sr);
like(`$ladder check places.xml 2>&1`, qr/^places\.xml:\d+: error LD752/m, 'with nothing at all it is refused');

# Lists with variables of one name: the first keeps it, and each text says the variable that it meant.
(my $lists = $application) =~ s{(</globalVars>)}{$1 . join '', map { my $list = $_; "<globalVars name=\"$list\">" . $variables->("GO:INT", "${list}Own:INT", 'EN:INT', 'Go_1:INT') . '</globalVars>' } qw(GVL2 GVL3 Silent)}e;
$lists =~ s{N := N \+ 1;}{N := N + GVL2.Go + gvl3.go; GVL2.Go := 3; GVL3.GO := GVL2.Go + 1; GVL2.Go_1 := 70; GVL3.Go_1 := 71; GVL2.EN := 5; GVL3.EN := GVL2.EN + 1; B := GVL.Go; // GVL2.Go };
$lists =~ s{<expression>NOT GVL.Go<}{<expression>NOT GVL.Go AND GVL2.Go &lt; 9<};
spew('lists.xml', $lists);
$report = `$ladder import lists.xml -o lists.rung 2>&1`;
is($?, 0, 'lists with the same names: imported') or diag($report . slurp('lists.rung'));
is(join(' ', sort $report =~ /changed: the name "(.*?)" becomes/g), 'EN GVL2.GO GVL3.EN GVL3.GO GVL3.Go_1 Silent.EN Silent.GO Silent.Go_1', 'each name that changes is told') or diag($report);
$made = slurp('lists.rung');
my %to = map { /"(.*?)" becomes (\w+)/ } grep { /becomes/ } split /\n/, $report;
is(scalar(keys %{{ map { uc, 1 } values %to }}), 8, 'and each gets one of its own') or diag($report);
like($made, qr/N := N \+ GVL2\.$to{'GVL2.GO'} \+ gvl3\.$to{'GVL3.GO'};/, 'a text says the variable of its list');
like($made, qr/NOT GVL\.Go AND GVL2\.$to{'GVL2.GO'} < 9/, 'so does an expression of a chart');
spew('script', "\@print MAIN.N $to{'GVL2.GO'} $to{'GVL3.GO'} Go_1 $to{'GVL3.Go_1'} EN_1 $to{'GVL3.EN'}\nGo=1\n. x3\n");
like(`$ladder trace lists.rung script 2>&1`, qr/MAIN\.N=1[0-9]\D.*\b\Q$to{'GVL2.GO'}\E=3\b.*\b\Q$to{'GVL3.GO'}\E=4\b.*Go_1=70\b.*=71\b.*EN_1=5\b.*=6\b/s, 'and it runs so') or diag(`$ladder trace lists.rung script 2>&1`, $report);

# The unit of the settings: those that literals have, whatever the sign of micro; another one is told.
for ([us => 'us'], ["\xc2\xb5s" => 'us'], ["\xce\xbcs" => 'us'], [ms => 'ms'], [s => 's'], [m => 'm'], [h => 'h'], [d => 'd'], [ns => 'ns'], [MS => 'ms'], [ticks => undef], ["\xc2\xb5" => undef], ['us, PRIORITY := 9' => undef]) {
	my ($unit, $is) = @$_;
	my $amount = {h => '1.5', d => 1, ns => 500_000}->{$unit} // 500;
	spew('unit.xml', $application =~ s/IntervalUnit="us"/IntervalUnit="$unit"/r =~ s/Interval="500"/Interval="$amount"/r);
	my $said = `$ladder import unit.xml -o unit.rung 2>&1`;
	is($?, 0, "the unit $unit: imported") or diag($said);
	my ($interval) = slurp('unit.rung') =~ /INTERVAL := (.*?), PRIORITY := 3\)/;
	is($interval, defined $is ? "T#$amount$is" : 'T#20ms', "the unit $unit: " . ($is // 'none'));
	my $lost = () = $said =~ /lost: TaskSettings IntervalUnit="\Q$unit\E" is left out|lost: TaskSettings Interval="500" is left out|changed: the task Often says no interval; it gets 20 ms/g;
	is($lost, defined $is ? 0 : 3, "the unit $unit: " . (defined $is ? 'nothing is lost' : 'it is told')) or diag($said);
}
spew('unit.xml', $application =~ s/Interval="500"/Interval="inf"/r);
like(`$ladder import unit.xml -o unit.rung 2>&1`, qr/lost: TaskSettings Interval="inf" is left out/, 'an interval that is no number is told');

done_testing;
