#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# plcopen.t - projects in PLCopen XML: what each element becomes, and that each one reaches the
# program or the report. docs.t runs the example of docs/plcopen.md.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use JSON::PP;
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $tests = dirname(abs_path(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
chdir $folder or die;

sub spew { my ($name, $text) = @_; open my $out, '>', $name or die; print $out $text; close $out or die }
sub slurp { my ($name) = @_; local $/; open my $in, '<', $name or return ''; return <$in> }
sub answer { my ($command) = @_; my $text = `$command 2>&1`; return ($text, $? >> 8) }

# This build may be one without libxml2.
spew('probe.xml', '<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types/></project>');
if ((answer("$ladder check probe.xml"))[0] =~ /LD040/) {
	plan skip_all => 'built without libxml2';
}

my $head = <<'END';
<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml">
<fileHeader companyName="C" productName="P" productVersion="1" creationDateTime="2026-01-01T00:00:00"/>
<contentHeader name="All"><coordinateInfo><fbd><scaling x="1" y="1"/></fbd><ld><scaling x="1" y="1"/></ld><sfc><scaling x="1" y="1"/></sfc></coordinateInfo></contentHeader>
<types>
END
my $tail = "<instances><configurations/></instances>\n</project>\n";

sub variable {
	my ($name, $type, $more) = @_;
	$type = $type =~ /^[A-Z]+$/ && $type !~ /^(TON|CTU|R_TRIG|PID|HYSTERESIS|RAMP)$/ ? "<$type/>" : $type =~ /^</ ? $type : "<derived name=\"$type\"/>";
	return "<variable name=\"$name\"><type>$type</type>" . ($more // '') . "</variable>\n";
}
sub pou {
	my ($name, $kind, $interface, $body) = @_;
	return "<pou name=\"$name\" pouType=\"$kind\">\n<interface>$interface</interface>\n$body</pou>\n";
}
sub project { my ($types, $pous) = @_; return "$head<dataTypes>$types</dataTypes>\n<pous>\n$pous</pous>\n</types>\n$tail" }
sub text_body { my ($language, $text) = @_; return "<body><$language><xhtml:p><![CDATA[\n$text\n]]></xhtml:p></$language></body>\n" }

# The rung file of a project without its heading lines, and the report.
sub imported {
	my ($name, $xml, $status) = @_;
	spew("$name.xml", $xml);
	unlink "$name.rung";
	my ($said, $got) = answer("$ladder import $name.xml -o $name.rung");
	is($got, $status // 0, "$name: status") or diag $said;
	return (slurp("$name.rung"), $said);
}
# What a script prints with the XML itself.
sub trace_is {
	my ($name, $script, $expected) = @_;
	spew('script', $script);
	is(scalar `$ladder trace --changes $name.xml script 2>warnings`, $expected, "$name: trace");
}

# ---- declarations ----
my $types = <<'END';
<dataType name="Color"><baseType><enum><values><value name="Red"/><value name="Green" value="5"/></values></enum></baseType>
<initialValue><simpleValue value="Green"/></initialValue></dataType>
<dataType name="Part"><baseType><struct>
<variable name="Speed"><type><INT/></type><initialValue><simpleValue value="7"/></initialValue></variable>
<variable name="Times"><type><array><dimension lower="1" upper="3"/><baseType><TIME/></baseType></array></type></variable>
</struct></baseType></dataType>
<dataType name="Percent"><baseType><subrangeSigned><range lower="0" upper="100"/><baseType><INT/></baseType></subrangeSigned></baseType></dataType>
<dataType name="Speed2"><baseType><REAL/></baseType></dataType>
END
my $values = '<initialValue><arrayValue><value repetitionValue="2"><simpleValue value="4"/></value><value><simpleValue value="9"/></value></arrayValue></initialValue>';
my $members = '<initialValue><structValue><value member="Speed"><simpleValue value="3"/></value></structValue></initialValue>';
my ($rung, $said) = imported('types', project($types, pou('Main', 'program', "<localVars>\n"
	. variable('Table', '<array><dimension lower="0" upper="2"/><baseType><INT/></baseType></array>', $values)
	. variable('Now', 'Part', $members) . variable('Lamp', 'Color') . variable('Share', 'Percent')
	. variable('Name', '<string length="12"/>', '<initialValue><simpleValue value="it"/></initialValue>')
	. variable('Sum', 'INT', '<documentation><xhtml:p>of all</xhtml:p></documentation>') . '</localVars>',
	text_body('ST', "Sum := Table[0] + Table[2] + Now.Speed;"))));
like($rung, qr/^  Color\s*: \(Red, Green := 5\) := Green;/m, 'an enumeration');
like($rung, qr/^    Speed\s*: INT := 7;/m, 'a structure');
like($rung, qr/^  Percent\s*: INT \(0\.\.100\);/m, 'a subrange');
like($rung, qr/Table\s*: ARRAY\[0\.\.2\] OF INT := \[2\(4\), 9\];/, 'values of an array');
like($rung, qr/Now\s*: Part := \(Speed := 3\);/, 'values of a structure');
like($rung, qr/Name\s*: STRING\[12\] := 'it';/, 'a text without its quotes');
like($rung, qr/Sum\s*: INT; \(\* of all \*\)/, 'documentation');
trace_is('types', "\@print Sum\n.\n", "1 t=10 Sum=16\n");

# ---- signs of XML in attributes ----
($rung, $said) = imported('signs', project('', pou('Main', 'program', '<localVars>' . variable('Name', '<string/>', '<initialValue><simpleValue value="\'a &amp; b &#38;#38; &lt;c&gt; &quot;d&quot; &#x26;\'"/></initialValue>') . '</localVars>',
	text_body('ST', "Name := Name;"))) =~ s/productName="P"/productName="This &amp; that"/r =~ s/contentHeader name="All"/contentHeader name="One &amp; &amp;two"/r);
like($rung, qr/^PROJECT "One & &two"/m, 'an & in the name of a project');
like($rung, qr/Name : STRING := 'a & b &#38; <c> "d" &';/, 'and in a value');

# ---- a WSTRING is a STRING here, with its texts ----
($rung, $said) = imported('wide', project('', pou('Main', 'program', '<localVars>'
	. variable('Name', '<wstring/>', '<initialValue><simpleValue value="&quot;none&quot;"/></initialValue>') . variable('Plain', '<string/>') . variable('Same', 'BOOL') . '</localVars>',
	text_body('ST', q{Name := "it's $"so$" $$1"; (* "as it is" *)} . "\nPlain := 'a \"b\"';\n" . q{Same := Name = "it's $"so$" $$1";}))));
like($rung, qr/^  Name\s*: STRING := 'none';/m, 'the value of a WSTRING');
like($rung, qr/Name := 'it\$'s "so" \$\$1';\s+\(\* "as it is" \*\)/, 'its texts have the quotes of a STRING, a comment stays');
like($rung, qr/Plain := 'a "b"';/, 'and so does the text of a STRING');
trace_is('wide', "\@print Same Plain\n.\n", "1 t=10 Same=1 Plain='a \"b\"'\n");

# ---- what extensions of Beremiz have ----
($rung, $said) = imported('places', project('', pou('Main', 'program', '<localVars>'
	. variable('Level', 'HMI_INT') . variable('Count', 'HMI_UDINT')
	. join('', map { my ($name, $type, $at) = @$_; variable($name, $type) =~ s/<variable /<variable address="$at" /r }
		['Position', 'DINT', '%QD0.2'], ['Start', 'BOOL', '%IX0.2'], ['Speed', 'INT', '%QW3'], ['Third', 'LREAL', '%IL0.1.4'])
	. '</localVars>', text_body('ST', "IF Start THEN\n{{\n  if (x) { call(GetFbVar(Level)); }\n}}\n  Position := 7;\nEND_IF;\nSpeed := 1;"))));
like($rung, qr/Level\s*: INT;\n\s*Count\s*: UDINT;/, 'the numbers of a page');
like($rung, qr/^  Position\s+: DINT;\n  Start +AT %IX0\.2 : BOOL;\n  Speed +AT %QW3\s*: INT;\n  Third\s+: LREAL;/m, 'a place of a slave is no address here');
like($said, qr/lost: Main: "Position" has no address here: %QD0\.2 is none\n(?:.*\n)*.*lost: Main: "Third" has no address here: %IL0\.1\.4 is none/s, 'and is told');
like($rung, qr/^\s*\{\{\n  if \(x\) \{ call\(GetFbVar\(Level\)\); \}\n\}\}\n/m, 'C between two braces is kept');
trace_is('places', "\@print Position\nStart=1\n", "1 t=10 Position=7\n");

# ---- addresses ----
sub located { my ($name, $type, $at) = @_; return variable($name, $type) =~ s/<variable /<variable address="$at" /r }
# Beremiz and OpenPLC count words and keep widths apart; CODESYS counts words, and widths share memory; TwinCAT counts bytes.
my $apart = join '', map { located(@$_) } ['Run', 'BOOL', '%QX0.0'], ['Slow', 'INT', '%QW0'], ['Fast', 'INT', '%QW1'], ['Sum', 'DINT', '%QD1'], ['Temp', 'INT', '%IW1'], ['Old', 'INT', '%IW3'];
sub addresses { return join ' ', $_[0] =~ / AT (%\S+)/g }
my $act = text_body('ST', "Run := Temp > 0;\nSlow := 257;\nFast := 1;\nSum := Slow + Fast + WORD_TO_INT(%IW3);");
($rung, $said) = imported('apart', project('', pou('Main', 'program', "<localVars>$apart</localVars>", $act)));
is(addresses($rung), '%QX0.0 %QW2 %QW4 %QD12 %IW1 %IW3', 'each width gets a part of the outputs; inputs that share nothing stay');
like($said, qr/changed: the address %QW0 becomes %QW2: /, 'which is told');
trace_is('apart', "\@print Slow Fast Sum\n%IW3=3\n", "1 t=10 Slow=257 Fast=1 Sum=261\n");
my $codesys = '<addData><data name="http://www.3s-software.com/plcopenxml/projectinformation" handleUnknown="implementation"><ProjectInformation/></data></addData></project>';
($rung, $said) = imported('sized', project('', pou('Main', 'program', "<localVars>$apart</localVars>", $act)) =~ s{</project>}{$codesys}r);
is(addresses($rung), '%QX0.0 %QW0 %QW2 %QD4 %IW1 %IW3', 'CODESYS counts words of the same memory');
($rung, $said) = imported('bytes', project('', pou('Main', 'program', "<localVars>$apart</localVars>", $act)) =~ s{</project>}{$codesys}r =~ s/productName="[^"]*"/productName="TwinCAT PLC Control"/r);
is(addresses($rung), '%QX0.0 %QW0 %QW1 %QD1 %IW1 %IW3', 'TwinCAT counts bytes, as here');
($rung, $said) = imported('direct', project('', pou('Main', 'program', '<localVars>' . variable('N', 'INT') . '</localVars>',
	text_body('ST', "(* %QW9 *)\n%QW0 := 257;\n%QW1 := 1;\nN := WORD_TO_INT(%QW0);"))));
like($rung, qr/\(\* %QW9 \*\)\s+%QW0 := 257;\s+%QW2 := 1;\s+N := WORD_TO_INT\(%QW0\);/, 'addresses in lines');

# A type of another width, and an input that the program stores into, are variables without address.
($rung, $said) = imported('narrow', project('', pou('Main', 'program', '<localVars>' . join('', map { located(@$_) } ['Level', 'REAL', '%IW4'], ['Name', 'STRING', '%QB8'], ['Go', 'BOOL', '%IX0.0'],
	['Seen', 'BOOL', '%IX0.1'], ['Kept', 'INT', '%IW2'], ['Bit', 'BOOL', '%IX0.2']) . variable('Up', 'CTU') . '</localVars>',
	text_body('ST', "Up(CU := Go, PV := 3);\nIF Go THEN Seen := TRUE; Kept := 4; END_IF;\nUp(CU := FALSE, R := Bit);"))));
like($rung, qr/^  Level\s+: REAL;\n  Name\s+: STRING;\n  Go +AT %IX0\.0 : BOOL;\n  Seen\s+: BOOL;\n  Kept\s+: INT;\n  Bit +AT %IX0\.2 : BOOL;/m, 'what fits keeps its address');
like($said, qr/"Level" has no address here: %IW4 is not as wide as REAL/, 'the width is told');
like($said, qr/"Seen" has no address here: the program stores into the input %IX0\.1/, 'the store is told');
trace_is('narrow', "\@print Seen Kept\n.\nGo=1\nGo=0\n", "2 t=20 Seen=1 Kept=4\n");
# The store of another POU into a variable of its own is none.
($rung, $said) = imported('other', project('', pou('Main', 'program', '<localVars>' . located('Go', 'BOOL', '%IX0.0') . located('Q', 'BOOL', '%QX0.0') . '</localVars>', text_body('ST', 'Q := Go;'))
	. pou('Side', 'program', '<localVars>' . variable('Go', 'BOOL') . '</localVars>', text_body('ST', 'Go := NOT Go;'))));
like($rung, qr/Go AT %IX0\.0 : BOOL;/, 'a variable of another POU has its own name');

# Returns in a text, and the interval of older versions of Beremiz.
($rung, $said) = imported('returns', project('', pou('Main', 'program', '<localVars>' . variable('N', 'INT') . '</localVars>', "<body><ST><xhtml:p>N := N + 1;&#13;\n(* a *)&#13;\nN := N&#13;+ 1;&#13;\n</xhtml:p></ST></body>"))
	=~ s{<configurations/>}{<configurations><configuration name="C"><resource name="R"><task name="T" priority="0" interval="00:00:00.100000"><pouInstance name="M" typeName="Main"/></task></resource></configuration></configurations>}r);
unlike($rung, qr/\r/, 'returns are ends of lines');
like($rung, qr/INTERVAL := T#100ms/, 'the interval of a clock');

# ---- actions of CODESYS that are charts ----
sub link_to { return '<connectionPointIn>' . join('', map { "<connection refLocalId=\"$_\"/>" } @_) . '</connectionPointIn>' }
sub when { my ($id, $from, $text) = @_; return "<transition localId=\"$id\">" . link_to($from) . "<condition><inline name=\"\"><ST><xhtml:p>$text</xhtml:p></ST></inline></condition></transition>\n" }
sub does { my ($id, $step, @what) = @_; return "<actionBlock localId=\"$id\">" . link_to($step) . join('', map { "<action localId=\"$id$_\" qualifier=\"N\"><reference name=\"$_\"/><connectionPointOut/></action>" } @what) . "</actionBlock>\n" }
sub chart_action { my ($name, $start, $stop, @what) = @_;
	return "<action name=\"$name\"><body><SFC>\n<step localId=\"1\" initialStep=\"true\" name=\"${name}_off\"><connectionPointIn/></step>\n" . when(2, 1, $start) .
		"<step localId=\"3\" name=\"${name}_on\">" . link_to(2) . "</step>\n" . does(4, 3, @what) . when(5, 3, $stop) . '<jumpStep localId="6" targetName="' . $name . '_off">' . link_to(5) . "</jumpStep>\n</SFC></body></action>\n" }
my $inputs = join '', map { variable($_, 'BOOL') } qw(Start SFCReset);
my $many = join '', map { variable("Nr$_", 'INT') } 1 .. 25;
my $sum = join '', map { "Nr$_ := Nr$_ + 1; " } 1 .. 25;
my $block = pou('Pump', 'functionBlock', "<inputVars>$inputs</inputVars><outputVars>" . variable('Runs', 'BOOL') . variable('Fast', 'BOOL') . '</outputVars><localVars>' . variable('Wait', 'TON') . $many . '</localVars>'
	. '<localVars constant="true">' . variable('Most', 'INT', '<initialValue><simpleValue value="3"/></initialValue>') . '</localVars>',
	text_body('ST', 'Wait(IN := Runs, PT := T#20ms);') . "<actions>\n" . chart_action('Move', 'Start AND Most = 3', 'NOT Start AND Nr25 &gt; 2', 'Runs', 'Count', 'Speed') . '<action name="Count"><body><ST><xhtml:p>' . $sum . '</xhtml:p></ST></body></action>'
	. chart_action('Speed', 'Wait.Q', 'FALSE', 'Fast') . "</actions>\n");
my $plant = pou('Main', 'program', '<localVars>' . join('', map { located(@$_) } ['Go', 'BOOL', '%IX0.0'], ['Halt', 'BOOL', '%IX0.1'], ['Runs', 'BOOL', '%QX0.0']) . variable('One', 'Pump') . variable('Two', 'Pump') . '</localVars>',
	text_body('ST', "One(Start := Go);\nIF Halt THEN One.Move(SFCReset := TRUE); ELSE One.Move(SFCReset := FALSE, Start := Go); END_IF;\nRuns := One.Runs;"));
($rung, $said) = imported('charts', project('', $block . $plant));
like($rung, qr/^FUNCTION_BLOCK Pump_Move SFC$/m, 'a chart becomes a block');
like($said, qr/changed: the action Pump\.Move is a chart: it becomes the function block Pump_Move, which the action calls/, 'which is told');
unlike($said, qr/: lost:/, 'and nothing is lost');
like($rung, qr/One\.SFCReset := FALSE;\s+One\.Start := Go;\s+One\.Move\(\);/, 'inputs of an action are stores before its call');
trace_is('charts', "\@print One.Runs One.Fast One.Nr1 One.Nr25 Two.Runs\n.\nGo=1\n. x3\nGo=0\n.\nGo=1 Halt=1\n.\nHalt=0\n.\n", join '',
	"2 t=20 One.Runs=1 One.Nr1=1 One.Nr25=1\n", "3 t=30 One.Nr1=2 One.Nr25=2\n", "4 t=40 One.Nr1=3 One.Nr25=3\n", "5 t=50 One.Fast=1 One.Nr1=4 One.Nr25=4\n",
	"6 t=60 One.Runs=0 One.Nr1=5 One.Nr25=5\n", "10 t=100 One.Runs=1 One.Nr1=6 One.Nr25=6\n", "11 t=110 One.Nr1=7 One.Nr25=7\n");

# CODESYS declares all flags at once: one that no body names is no news.
(my $flags = $block) =~ s{(<inputVars>)}{$1 . variable('SFCInit', 'BOOL')}e;
(undef, $said) = imported('flags', project('', $flags . $plant));
unlike($said, qr/SFCInit does nothing/, 'SFCInit beside SFCReset, which nothing stores into, is not in the report');
(my $stored = $plant) =~ s/One\.Move\(SFCReset := TRUE\)/One.Move(SFCReset := TRUE, SFCInit := TRUE)/;
(undef, $said) = imported('flags', project('', $flags . $stored));
like($said, qr/lost: Pump_Move: SFCInit does nothing beside SFCReset/, 'one that a body stores into is');

# CODESYS: the library stands before a block, pins of latches have other names, the line behind a box EXECUTE is Out1, and a coil behind a block is connected to its own name.
sub drawn_pin { my ($name, @from) = @_; return "<variable formalParameter=\"$name\">" . link_in(@from) . '</variable>' }
sub link_in { return '<connectionPointIn>' . join('', map { my ($id, $out) = split /:/; "<connection refLocalId=\"$id\"" . ($out ? " formalParameter=\"$out\"" : '') . '/>' } @_) . '</connectionPointIn>' }
sub drawn_contact { my ($id, $name) = @_; return "<contact localId=\"$id\"><position x=\"0\" y=\"0\"/>" . link_in(1) . "<connectionPointOut/><variable>$name</variable></contact>" }
sub drawn_coil { my ($id, $name, $from) = @_; return "<coil localId=\"$id\"><position x=\"0\" y=\"0\"/>" . link_in($from) . "<connectionPointOut/><variable>$name</variable></coil>\n" }
my $left_rail = '<leftPowerRail localId="1"><position x="0" y="0"/><connectionPointOut formalParameter=""/></leftPowerRail>';
my $latches = pou('Main', 'program', '<localVars>' . join('', map { located(@$_) } ['A', 'BOOL', '%IX0.0'], ['B', 'BOOL', '%IX0.1'], ['Q', 'BOOL', '%QX0.0'], ['R', 'BOOL', '%QX0.1'], ['Late', 'BOOL', '%QX0.2'], ['Done', 'BOOL', '%QX0.3'])
	. variable('First', '<derived name="Standard.SR"/>') . variable('Second', '<derived name="RS"/>') . variable('Off', '<derived name="TOF"/>') . variable('Number', 'INT') . '</localVars>',
	"<body><LD>$left_rail" . drawn_contact(2, 'A') . drawn_contact(3, 'B')
	. '<block localId="4" typeName="Standard.SR" instanceName="First"><position x="0" y="0"/><inputVariables>' . drawn_pin('SET1', 2) . drawn_pin('RESET', 3) . '</inputVariables><inOutVariables/><outputVariables><variable formalParameter="Q1"><connectionPointOut/></variable></outputVariables></block>' . drawn_coil(5, 'Q', '4:Q1')
	. '<block localId="6" typeName="RS" instanceName="Second"><position x="0" y="0"/><inputVariables>' . drawn_pin('SET', 2) . drawn_pin('RESET1', 3) . '</inputVariables><inOutVariables/><outputVariables><variable formalParameter="Q1"><connectionPointOut/></variable></outputVariables></block>' . drawn_coil(7, 'R', '6:Q1')
	. '<inVariable localId="11"><position x="0" y="0"/><connectionPointOut/><expression>T#25ms</expression></inVariable>'
	. '<block localId="8" typeName="TOF" instanceName="Off"><position x="0" y="0"/><inputVariables>' . drawn_pin('IN', 2) . drawn_pin('PT', 11) . '</inputVariables><inOutVariables/><outputVariables><variable formalParameter="Q"><connectionPointOut/></variable><variable formalParameter="ET"><connectionPointOut/></variable></outputVariables></block>' . drawn_coil(9, 'Late', '8:Late')
	. '<block localId="12" typeName="EXECUTE"><position x="0" y="0"/><inputVariables>' . drawn_pin('EN', 2) . '</inputVariables><inOutVariables/><outputVariables><variable formalParameter="Out1"/></outputVariables><addData>'
	. '<data name="http://www.3s-software.com/plcopenxml/fbdcalltype" handleUnknown="implementation"><CallType xmlns="">execute</CallType></data><data name="http://www.3s-software.com/plcopenxml/stcode" handleUnknown="implementation"><STCode xmlns="">Number := Number + 1;</STCode></data></addData></block>' . drawn_coil(13, 'Done', '12:Out1')
	. "</LD></body>\n");
imported('latches', project('', $latches));
trace_is('latches', "\@print Q R Late Done Number\n.\nA=1\nB=1\nA=0\nB=0\n. x3\n", join '',
	"2 t=20 Q=1 R=1 Late=1 Done=1 Number=1\n", "3 t=30 R=0 Number=2\n", "4 t=40 Q=0 Done=0\n", "7 t=70 Late=0\n");

# Some tools write the whole POU, with its declarations, where the body belongs.
my $whole = project('', pou('Twice', 'FUNCTION', '', text_body('ST', "(* Twice as\nmuch *)\nFUNCTION Twice : INT\nVAR_INPUT\n  X : INT;\nEND_VAR\nTwice := X * 2;\nEND_FUNCTION"))
	. pou('Count', 'FUNCTION_BLOCK', '', text_body('ST', "FUNCTION_BLOCK Count\nVAR_OUTPUT\n  N : INT;\nEND_VAR\nN := N + 1;\nEND_FUNCTION_BLOCK"))
	. pou('Main', 'PROGRAM', '', text_body('ST', "PROGRAM Main\nVAR\n  C : Count;\n  Sum : INT;\nEND_VAR\nC();\nSum := Twice(X := C.N);\nEND_PROGRAM")));
($rung, $said) = imported('whole', $whole);
like($rung, qr/^FUNCTION Twice : INT ST$/m, 'a function in its own body has its type');
unlike($said, qr/: (lost|changed):/, 'which is no change') or diag $said;
trace_is('whole', "\@print Main.Sum\n.\n.\n", "1 t=10 Main.Sum=2\n2 t=20 Main.Sum=4\n");
$whole =~ s/Sum := Twice/Sum := Nothing/;
($rung, $said) = imported('whole', $whole, 1);
my $nothing = 1 + (() = substr($whole, 0, index($whole, 'Sum := Nothing')) =~ /\n/g);
like($said, qr/whole\.xml:$nothing: error/, 'and an error its line') or diag $said;

# ---- what Beremiz and OpenPLC have in another way ----
my $own = '<localVars>' . join('', map { variable(@$_) } ['Loop', 'PID'], ['Out', 'REAL'], ['Held', 'REAL'], ['Long', 'DINT'], ['Wait', 'TIME'], ['Half', 'TIME'], ['Two', 'INT'], ['Wet', 'HYSTERESIS'], ['Slow', 'RAMP']) . '</localVars>';
my $lines = "Loop(AUTO := TRUE, PV := 3.0, SP := 1.0, X0 := 0.0, KP := 2.0, TR := 10.0, TD := 0.0, CYCLE := T#500ms);\nOut := Loop.XOUT;\nHeld := TIME_TO_REAL(T#1500ms);\n"
	. "Long := TIME_TO_DINT(T#90s);\nWait := INT_TO_TIME(3);\nHalf := REAL_TO_TIME(0.5);\nTwo := Share(Whole := 2);\nWet(XIN1 := Out, XIN2 := 5.0, EPS := 0.3);\n"
	. "Slow(RUN := TRUE, X0 := 0.0, X1 := 8.0, TR := T#40ms, CYCLE := T#10ms);";
my $share = pou('Share', 'function', '<returnType><INT/></returnType><inputVars>' . variable('Whole', 'INT') . variable('Twice', 'BOOL') . variable('More', 'INT', '<initialValue><simpleValue value="5"/></initialValue>') . '</inputVars>',
	text_body('ST', "Share := Whole + More;\nIF Twice THEN Share := Share * 2; END_IF;"));
($rung, $said) = imported('library', project('', pou('Main', 'program', $own, text_body('ST', $lines)) . $share));
like($said, qr/changed: the block PID of other tools has other pins: it becomes a block of the project/, 'a block with other pins is told');
like($said, qr/changed: TIME_TO_REAL counts seconds there and milliseconds here/, 'a conversion of TIME, too');
like($rung, qr/^  Twice : BOOL := FALSE;\n  More  : INT := 5;/m, 'an input that a call leaves out has a value');
# 2 * (error + the sum of error by time / TR), with an error of 2.
trace_is('library', "\@print Out Held Long Wait Half Two Wet.Q Slow.XOUT\n. x5\n", "1 t=10 Out=4.2 Held=1.5 Long=90 Wait=3000 Half=500 Two=7\n2 t=20 Out=4.4 Slow.XOUT=2\n3 t=30 Out=4.6 Slow.XOUT=4\n"
	. "4 t=40 Out=4.8 Slow.XOUT=6\n5 t=50 Out=5 Slow.XOUT=8\n");
($rung, $said) = imported('library2', project('', pou('Main', 'program', '<localVars>' . variable('Held', 'REAL') . '</localVars>', text_body('ST', 'Held := TIME_TO_REAL(T#1500ms);'))) =~ s{</project>}{$codesys}r);
trace_is('library2', "\@print Held\n.\n", "1 t=10 Held=1500\n");

# A list brings a result to a label.
imported('brought', project('', pou('Main', 'program', '<localVars>' . variable('Go', 'BOOL') . variable('Count', 'INT') . variable('Seen', 'INT') . '</localVars>',
	text_body('IL', "LD Go\nJMPC Clear\n(* one more *)\nLD Count\nADD 1\nJMP Save\nClear:\nLD 0\nSave:\nST Count\nST Seen"))));
trace_is('brought', "\@print Count Seen\n. x2\nGo=1\nGo=0\n", "1 t=10 Count=1 Seen=1\n2 t=20 Count=2 Seen=2\n3 t=30 Count=0 Seen=0\n4 t=40 Count=1 Seen=1\n");

# ---- lists, and an error in the line of the XML ----
my $count = variable('Count', 'INT') . variable('Go', 'BOOL');
imported('list', project('', pou('Main', 'program', "<localVars>$count</localVars>", text_body('IL', "LD Count\nADD 1\nST Count"))));
trace_is('list', "\@print Count\n. x2\n", "1 t=10 Count=1\n2 t=20 Count=2\n");
($rung, $said) = imported('wrong', project('', pou('Main', 'program', "<localVars>$count</localVars>",
	text_body('ST', "Count := 1;\nCount := Nowhere;"))), 1);
my $line = () = slurp('wrong.xml') =~ /\n(?=.*Nowhere)/gs;
like($said, qr/^wrong\.xml:@{[$line + 1]}: error LD301: "Nowhere"/m, 'the line of an error is that of the XML');
like($rung, qr/Count := Nowhere;/, 'a project with errors is written, too');

# ---- ladders ----
my $rail = '<leftPowerRail localId="1"/>';
sub wires { return '<connectionPointIn>' . join('', map { my ($id, $pin) = split /\./; "<connection refLocalId=\"$id\"" . ($pin ? " formalParameter=\"$pin\"" : '') . '/>' } @_) . '</connectionPointIn>' }
sub contact { my ($id, $name, $more, @from) = @_; return "<contact localId=\"$id\" $more>" . wires(@from) . "<connectionPointOut/><variable>$name</variable></contact>\n" }
sub coil { my ($id, $name, $more, @from) = @_; return "<coil localId=\"$id\" $more>" . wires(@from) . "<variable>$name</variable></coil>\n" }
sub given { my ($id, $text) = @_; return "<inVariable localId=\"$id\"><connectionPointOut/><expression>$text</expression></inVariable>\n" }
sub box {
	my ($id, $type, $name, $in, @out) = @_;
	my @in = map { my ($pin, @from) = split / /; "<variable formalParameter=\"$pin\">" . wires(@from) . '</variable>' } @$in;
	return "<block localId=\"$id\" typeName=\"$type\"" . ($name ? " instanceName=\"$name\"" : '') . '><inputVariables>' . join('', @in)
		. '</inputVariables><inOutVariables/><outputVariables>' . join('', map { "<variable formalParameter=\"$_\"><connectionPointOut/></variable>" } @out)
		. "</outputVariables></block>\n";
}
my $bits = join '', map { variable($_, 'BOOL') } 'A' .. 'F';
sub ladder_of { my ($name, $body, $more, $status) = @_; return imported($name, project('', pou('Main', 'program', "<localVars>$bits" . ($more // '') . '</localVars>', "<body><LD>\n$rail\n$body</LD></body>\n")), $status) }
sub rungs_are {
	my ($rung, $expected, $what) = @_;
	my ($rows) = $rung =~ /^((?:(?:\(\*.*\n)?RUNG.*\n(?:  .*\n)+)+)/m;
	is($rows // $rung, $expected, $what);
}
rungs_are((ladder_of('kinds', contact(2, 'A', '', 1) . contact(3, 'B', 'negated="true"', 2) . contact(4, 'C', 'edge="rising"', 3) . contact(5, 'D', 'edge="falling"', 4)
	. coil(6, 'E', 'storage="set"', 5) . coil(7, 'F', 'negated="true"', 5)))[0],
	"RUNG\n  | NO A | NC B | P C | N D | S E       |\n  |      |      |     |    ^| COILNOT F |\n", 'contacts and coils of each kind');
rungs_are((ladder_of('parallel', contact(2, 'A', '', 1) . contact(3, 'B', '', 2) . contact(4, 'C', '', 2) . contact(5, 'D', '', 1) . coil(6, 'E', '', 3, 4, 5)))[0],
	"RUNG\n  | NO A | NO B  | COIL E |\n  |     ^| NO C ^|\n  | NO D | ---  ^|\n", 'series and parallel');
rungs_are((ladder_of('splits', contact(2, 'A', '', 1) . coil(3, 'B', '', 2) . contact(4, 'B', '', 2) . coil(5, 'C', '', 4)))[0],
	"RUNG\n  | NO A | COIL B |\nRUNG\n  | NO A | NO B | COIL C |\n", 'a coil that the next output reads ends the rung');
trace_is('splits', "\@print A B C\n.\nA=1\n", "2 t=20 A=1 B=1 C=1\n");
rungs_are((ladder_of('boxes', contact(2, 'A', '', 1) . given(3, 'T#1s') . box(4, 'TON', 'Wait', ['IN 2', 'PT 3'], 'Q', 'ET') . coil(5, 'B', '', '4.Q'), variable('Wait', 'TON')))[0],
	"RUNG\n  | NO A | TON Wait PT:=T#1s | COIL B |\n", 'a block');
($rung, $said) = ladder_of('unknown', contact(2, 'A', '', 1) . box(4, 'NOBODY', 'Wait', ['IN 2'], 'Q') . coil(5, 'B', '', '4.Q') . contact(6, 'C', '', 1) . coil(7, 'D', '', 6));
like($rung, qr/^RUNG OFF "NOBODY is not known"\n.*Wait\(IN := A\);\n.*B := Wait\.Q;/ms, 'a block of a type that is not known stays, OFF');
like($said, qr/:\d+: changed: Main: the type of the block "NOBODY" is not known/, 'and is in the report');

# ---- functions that do not run ----
# While EN is FALSE, what takes the result keeps its value, one variable or several.
for my $more ('', '<outVariable localId="9" ><connectionPointIn><connection refLocalId="4" formalParameter="OUT"/></connectionPointIn><expression>M</expression></outVariable>') {
	my $name = $more ? 'several' : 'one';
	imported($name, project('', pou('Main', 'program', '<localVars>' . $bits . variable('N', 'UINT') . variable('M', 'UINT') . '</localVars>', '<body><FBD>'
		. given(2, 'A') . given(3, $more ? 'N + 7' : '7') . box(4, 'MOVE', '', ['EN 2', 'IN 3'], 'ENO', 'OUT')
		. "<outVariable localId=\"5\"><connectionPointIn><connection refLocalId=\"4\" formalParameter=\"OUT\"/></connectionPointIn><expression>N</expression></outVariable>\n$more"
		. '<outVariable localId="6"><connectionPointIn><connection refLocalId="4" formalParameter="ENO"/></connectionPointIn><expression>B</expression></outVariable></FBD></body>')));
	trace_is($name, "\@print N M B\n.\nA=1\nA=0\nN=3\n", $more ? "2 t=20 N=7 M=7 B=1\n3 t=30 B=0\n4 t=40 N=3\n" : "2 t=20 N=7 B=1\n3 t=30 B=0\n4 t=40 N=3\n");
}

# ---- charts ----
my $chart = <<'END';
<body><SFC>
<step localId="1" name="Rest" initialStep="true"><connectionPointIn><connection refLocalId="7"/></connectionPointIn><connectionPointOut/></step>
<selectionDivergence localId="2"><connectionPointIn><connection refLocalId="1"/></connectionPointIn><connectionPointOut/></selectionDivergence>
<transition localId="3"><position x="0" y="1"/><connectionPointIn><connection refLocalId="2"/></connectionPointIn><connectionPointOut/><condition><inline name=""><ST><xhtml:p>A AND B</xhtml:p></ST></inline></condition></transition>
<transition localId="4"><position x="9" y="1"/><connectionPointIn><connection refLocalId="2"/></connectionPointIn><connectionPointOut/><condition><reference name="Named"/></condition></transition>
<step localId="5" name="Left"><connectionPointIn><connection refLocalId="3"/></connectionPointIn><connectionPointOut/></step>
<jumpStep localId="6" targetName="Left"><connectionPointIn><connection refLocalId="4"/></connectionPointIn></jumpStep>
<transition localId="7"><position x="0" y="9"/><connectionPointIn><connection refLocalId="5"/></connectionPointIn><connectionPointOut/><condition><connectionPointIn><connection refLocalId="9"/></connectionPointIn></condition></transition>
<leftPowerRail localId="8"/>
<contact localId="9" negated="true"><connectionPointIn><connection refLocalId="8"/></connectionPointIn><connectionPointOut/><variable>A</variable></contact>
<actionBlock localId="10"><connectionPointIn><connection refLocalId="5"/></connectionPointIn>
<action localId="0" qualifier="D" duration="T#20ms"><reference name="E"/></action>
<action localId="0"><reference name="Work"/></action>
<action localId="0" qualifier="P1"><inline><ST><xhtml:p>F := NOT F;</xhtml:p></ST></inline></action></actionBlock>
</SFC></body>
<actions><action name="Work"><body><ST><xhtml:p>D := TRUE;</xhtml:p></ST></body></action></actions>
<transitions><transition name="Named"><body><ST><xhtml:p>:= C;</xhtml:p></ST></body></transition></transitions>
END
($rung, $said) = imported('chart', project('', pou('Main', 'program', "<localVars>$bits</localVars>", $chart)));
like($rung, qr/TRANSITION FROM Rest TO Left := A AND B; END_TRANSITION\n\n  TRANSITION FROM Rest TO Left := C; END_TRANSITION\n\n  TRANSITION FROM Left TO Rest := NOT A;/, 'transitions');
like($rung, qr/STEP Left:\n    E\(D, T#20ms\);\n    Work\(N\);\n    Left_Inline1\(P1\);/, 'actions');
like($said, qr/0 changed, 0 lost/, 'nothing of it is lost');

# ---- configuration ----
my $config = <<'END';
<instances><configurations><configuration name="Plant"><resource name="Cpu 1">
<task name="Fast" interval="PT0.005S" priority="1"><pouInstance name="One" typeName="Main"/></task>
<globalVars constant="true"><variable name="Step1"><type><INT/></type><initialValue><simpleValue value="2"/></initialValue></variable></globalVars>
</resource><globalVars><variable name="All"><type><INT/></type></variable></globalVars></configuration></configurations></instances>
END
($rung, $said) = imported('config', project('', pou('Main', 'program', '<externalVars>' . variable('All', 'INT') . variable('Lost', 'INT') . '</externalVars>',
	text_body('ST', "All := All + Step1;\nLost := All;"))) =~ s/<instances>.*<\/instances>\n/$config/sr);
like($rung, qr/TASK Fast \(INTERVAL := T#5ms, PRIORITY := 1\);/, 'a task');
like($rung, qr/PROGRAM One WITH Fast : Main;/, 'an instance');
like($said, qr/changed: the name "Cpu 1" becomes Cpu_1/, 'a name with a blank');
like($said, qr/changed: "Lost" is in VAR_EXTERNAL, and nothing declares it/, 'a global variable that is missing');

# ---- nothing is lost without a word ----
# An element that nobody knows, at each place of these projects: the report must name its line.
for my $name (qw(types kinds boxes chart config)) {
	my @lines = split /(?<=\n)/, slurp("$name.xml");
	my (@silent, $tried);
	for my $at (2 .. $#lines) {
		next if $lines[$at - 1] !~ />\s*$/ || $lines[$at - 1] =~ /CDATA|<\/project>|<xhtml|\?>/ || $lines[$at] =~ /\]\]/;
		spew('more.xml', join '', @lines[0 .. $at - 1], "<unheard name=\"of\"/>\n", @lines[$at .. $#lines]);
		my ($text) = answer("$ladder import more.xml");
		my $here = $at + 1;
		push @silent, $here if $text !~ /^more\.xml:$here: (?:lost: .*unheard|error)/m;
		$tried++;
	}
	is("@silent", '', "$name: each of $tried further elements is in the report");
}

# The report as JSON says the same.
my $json = decode_json(scalar `$ladder import --json config.xml 2>warnings`);
is(scalar(grep { $_->{kind} eq 'changed' } @{$json->{report}}), 2, 'the report as JSON');

# Every name of a variable is in the result.
for my $name (qw(types kinds boxes chart config)) {
	my $result = slurp("$name.rung");
	my @missing = grep { $result !~ /\b\Q$_\E\b/ } slurp("$name.xml") =~ /<variable name="([^"]+)"/g;
	is("@missing", '', "$name: all variables are there");
}

# ---- the interface tells the globals that a body uses ----
spew('globals.rung', <<'END');
RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Level : INT;
  Never : BOOL;
  Delay : TON;
  Odd   : INT (0..9);
END_VAR
VAR CONSTANT
  Most : INT := 7;
END_VAR

PROGRAM Main LD
VAR
  Own : BOOL;
END_VAR
RUNG
  | NO Start | [ Level > Most ] | TON Delay PT:=T#1s | COIL Own |
RUNG
  | NO Own | [ Odd := Odd + 1 ] |
END_PROGRAM

PROGRAM Other ST
VAR_EXTERNAL
  Start : BOOL;
END_VAR
  IF Start AND Delay.Q THEN
    Level := 1;
  END_IF;
END_PROGRAM
END
my ($told, $exported) = answer("$ladder export --as plcopen globals.rung -o globals.xml");
is($exported, 0, 'globals are exported') or diag $told;
my %uses = slurp('globals.xml') =~ m{<pou name="(\w+)".*?<interface>(.*?)</interface>}gs;
my %lists = map { my $pou = $_; $pou => join ' ', map { my ($constant, $list) = /^( constant="true")?>(.*)/s;
	($constant ? 'constant:' : ()), $list =~ /<variable name="(\w+)"/g } $uses{$pou} =~ m{<externalVars(.*?)</externalVars>}gs } keys %uses;
is($lists{Main}, 'Start Level Delay constant: Most', 'each once; none that it does not use; none whose type has no name');
is($lists{Other}, 'Start Level Delay', 'beside those that it tells itself');

# ---- power before and behind a block without a BOOL pin goes through EN and ENO ----
spew('power.rung', <<'END');
RUNGBOARD 1

VAR
  Go AT %IX0.0 : BOOL;
  Lamp AT %QX0.0 : BOOL;
  One : Count;
END_VAR

FUNCTION_BLOCK Count ST
VAR_INPUT
  By : INT := 1;
END_VAR
VAR_OUTPUT
  Sum : INT;
END_VAR
  Sum := Sum + By;
END_FUNCTION_BLOCK

PROGRAM Main LD
RUNG
  | NO Go | Count One By:=2 | COIL Lamp |
END_PROGRAM
END
answer("$ladder export --as plcopen power.rung -o power.xml");
(my $alone = slurp('power.xml')) =~ s{<addData>.*?</addData>}{}s; # the text beside the drawing
my ($again) = imported('powered', $alone);
spew('power.script', "\@print Lamp One.Sum\n.\n. Go=1\n.\n. Go=0\n.\n");
my @traces = map { scalar `$ladder trace $_ power.script 2>warnings` } qw(power.rung powered.rung);
like($traces[0], qr/Lamp=1 One.Sum=/, 'the block runs');
is($traces[1], $traces[0], 'the drawing alone does the same');

# ---- hostile files ----
for my $name (qw(kinds chart)) {
	my $xml = slurp("$name.xml");
	my @wrong;
	for my $cut (map { int(length($xml) * $_ / 40) } 1 .. 39) {
		spew('cut.xml', substr $xml, 0, $cut);
		my ($text, $status) = answer("timeout 20 $ladder import cut.xml");
		push @wrong, $cut if $status != 1 || $text !~ /^cut\.xml(?::\d+)*: error LD/m;
	}
	is("@wrong", '', "$name: a part of it is refused");
}
spew('large.xml', project('', '') . ' ' x (101 << 20));
my ($large, $status) = answer("timeout 60 $ladder import large.xml");
ok($status && $large =~ /^large\.xml: error LD/, '100 MB') or diag $large;

done_testing;
