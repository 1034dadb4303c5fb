#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# iec_files.t - text files of TwinCAT 3 and CODESYS 2.3 as they come out of those tools: what they say runs,
# each message has its place in the file, and what has no form here is told.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib dirname(abs_path(__FILE__));
use Files;

my $build = $ENV{BUILD} // dirname(abs_path(__FILE__)) . '/../build';
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
chdir tempdir(CLEANUP => 1) or die;

# Both streams and the status of a command.
sub said {
	my $out = qx({ @_; } 2>&1);
	return ($out, $? >> 8);
}

sub tc {
	my ($kind, $name, $inside) = @_;
	return qq(\xef\xbb\xbf<?xml version="1.0" encoding="utf-8"?>\r\n<TcPlcObject Version="1.1.0.1" ProductVersion="3.1.4024.9">\r\n)
		. qq(  <$kind Name="$name" Id="{00000000-0000-0000-0000-000000000001}">\r\n$inside  </$kind>\r\n</TcPlcObject>\r\n);
}
sub declaration { my ($text) = @_; return "    <Declaration><![CDATA[$text]]></Declaration>\r\n"; }
sub body { my ($text) = @_; return "    <Implementation>\r\n      <ST><![CDATA[$text]]></ST>\r\n    </Implementation>\r\n"; }

my $main = "PROGRAM MAIN\r\nVAR\r\n  pump : FB_Pump;\r\n  mode : E_Mode;\r\n  n : INT;\r\nEND_VAR\r\n";
my $steps = "pump(start := n >= 2 AND n < 4);\r\nn := n + 1;\r\nIF pump.running THEN\r\n  mode := E_Mode.Run;\r\n"
	. "  Totals.Runs := totals . runs + 1; // not Totals.Nothing\r\nELSE\r\n  mode := E_Mode.Idle;\r\nEND_IF\r\nTotals.Last := mode";
my %file = (
	'tc/MAIN.TcPOU' => tc('POU', 'MAIN', declaration($main) . body("$steps;")
		. "    <LineIds Name=\"MAIN\">\r\n      <LineId Id=\"3\" Count=\"2\" />\r\n    </LineIds>\r\n"),
	'tc/FB_Pump.TcPOU' => tc('POU', 'FB_Pump',
		declaration("FUNCTION_BLOCK FB_Pump\r\nVAR_INPUT start : BOOL; END_VAR\r\nVAR_OUTPUT running : BOOL; END_VAR")
		. body("running := start; // no line behind it")),
	'tc/E_Mode.TcDUT' => tc('DUT', 'E_Mode', declaration("TYPE E_Mode : (Idle := 0, Run := 7);\r\nEND_TYPE\r\n")),
	'tc/Totals.TcGVL' => tc('GVL', 'Totals', declaration("VAR_GLOBAL\r\n  Runs : DINT;\r\n  Last : E_Mode;\r\nEND_VAR\r\n")),
);
mkdir $_ for qw(tc other);
sub put { my (%with) = (%file, @_); spew($_, $with{$_}) for keys %with; }
spew('script', ". x4\n");
put();

my ($out) = said("$ladder trace tc script 2>/dev/null");
is($out, <<'END', 'program, block, type and list of global variables are one project');
1 t=10 Runs=0 Last=Idle pump.start=0 pump.running=0 mode=Idle n=1
2 t=20 Runs=0 Last=Idle pump.start=0 pump.running=0 mode=Idle n=2
3 t=30 Runs=1 Last=Run pump.start=1 pump.running=1 mode=Run n=3
4 t=40 Runs=2 Last=Run pump.start=1 pump.running=1 mode=Run n=4
END
is((said("$ladder trace tc/*.Tc* script 2>/dev/null"))[0], $out, 'the files one by one are the same project');

like((said("$ladder check tc/*.Tc*"))[0], qr{^tc/E_Mode\.TcDUT, tc/FB_Pump\.TcPOU, tc/MAIN\.TcPOU, tc/Totals\.TcGVL: good}m, 'four files are named in the sum');
like((said("$ladder check tc/*.Tc* tc/E_Mode.TcDUT"))[0], qr{^5 files: \d+ errors?}m, 'more are counted');

# ---- places ----

put('tc/MAIN.TcPOU' => tc('POU', 'MAIN', declaration($main) . body("n := m;\r\n$steps;")));
($out) = said("$ladder check tc");
like($out, qr{^tc/MAIN\.TcPOU:12:\d+: error LD301: "m" is not declared$}m, 'a mistake in a body has its line');
put('tc/Totals.TcGVL' => tc('GVL', 'Totals', declaration("VAR_GLOBAL\r\n  Runs : DINT;\r\n  Last : E_Mode;\r\n  Spare : INT;\r\nEND_VAR\r\n")));
($out) = said("$ladder check tc");
like($out, qr{^tc/Totals\.TcGVL:7: warning LD325: "Spare"}m, 'a message about a global variable names its file');
like((said("$ladder xref tc Spare"))[0], qr{tc/Totals\.TcGVL:7}, 'so does the cross reference');
put('tc/MAIN.TcPOU' => tc('POU', 'MAIN', declaration($main) . body($steps)));
($out, my $status) = said("$ladder check tc");
ok($status == 1 && $out =~ m{^tc/MAIN\.TcPOU:\d+}m, 'a ; that is missing at the end is told');

# ---- names of lists ----

put('tc/MAIN.TcPOU' => tc('POU', 'MAIN', declaration($main) . body("Totals.Nothing := 1;")));
like((said("$ladder check tc"))[0], qr{LD301: "Nothing"}, 'a list does not have everything');
put('tc/MAIN.TcPOU' => tc('POU', 'MAIN', declaration("PROGRAM MAIN\r\nVAR\r\n  Totals : Own;\r\nEND_VAR\r\n")
	. body("Totals.Runs := Totals.Runs + 2;")),
	'tc/Own.TcDUT' => tc('DUT', 'Own', declaration("TYPE Own : STRUCT\r\n  Runs : INT;\r\nEND_STRUCT\r\nEND_TYPE\r\n")));
like((said("$ladder trace tc script"))[0], qr{^4 .*Runs=0 .*Totals\.Runs=8}m, 'a variable with the name of a list is that variable');
unlink 'tc/Own.TcDUT';

# ---- other markup ----

put('tc/MAIN.TcPOU' => tc('POU', 'MAIN', declaration("PROGRAM MAIN\r\nVAR\r\n  n : INT;\r\n  ok : BOOL;\r\nEND_VAR\r\n")
	. "    <Implementation><ST>n := n + 1; ok := n &gt; 2 &amp; n &lt; 4;</ST></Implementation>\r\n<!-- <ST> -->\r\n"));
like((said("$ladder trace tc script"))[0], qr{^2 .*ok=0\n3 .*ok=1\n4 .*ok=0$}m, 'text without CDATA has entities');
for my $part (['a drawn body', '<Implementation><NWL><XmlArchive/></NWL></Implementation>', 'NWL'],
	['a method', '<Method Name="Go" Id="{1}"><Declaration><![CDATA[METHOD Go : BOOL]]></Declaration></Method>', 'Go'],
	['a property', '<Property Name="Speed" Id="{1}"><Get Name="Get"></Get></Property>', 'Speed']) {
	my ($what, $xml, $name) = @$part;
	put('tc/MAIN.TcPOU' => tc('POU', 'MAIN', declaration($main) . ($what =~ /body/ ? '' : body("$steps;")) . "$xml\r\n"));
	($out, $status) = said("$ladder check tc");
	ok($status == 1 && $out =~ m{^tc/MAIN\.TcPOU:\d+:\d+: error LD\d+: "\Q$name\E"}m, "$what is told: $name") or diag $out;
	unlike($out, qr{METHOD|is not a known type}, "$what is left out as a whole");
}

# A file that was cut gives an error with its name, or had nothing behind the cut.
put();
my $whole = $file{'tc/MAIN.TcPOU'};
my $bad = '';
for (my $len = length($whole) - 1; $len > 0; $len -= 23) {
	next if substr($whole, $len) !~ /\S/;
	spew('tc/MAIN.TcPOU', substr($whole, 0, $len));
	($out, $status) = said("$ladder check tc");
	$bad .= "$len: $status $out" unless $status == 1 && $out =~ m{^tc/MAIN\.TcPOU:.*error}m;
}
is($bad, '', 'a file that ends too early is an error');

# ---- CODESYS 2.3 ----

spew('pump.EXP', <<'END');

(* @NESTEDCOMMENTS := 'Yes' *)
(* @PATH := '' *)
(* @OBJECTFLAGS := '0, 8' *)
(* @SYMFILEFLAGS := '2048' *)
PROGRAM PLC_PRG
VAR
	n: INT;
	level: REAL := 1.5;
END_VAR
(* @END_DECLARATION := '0' *)
n := n + 1;
Total := Total + Twice(n);
level := level * 2.0;

END_PROGRAM


(* @NESTEDCOMMENTS := 'Yes' *)
(* @PATH := '' *)
FUNCTION Twice : INT
VAR_INPUT
	x: INT;
END_VAR
(* @END_DECLARATION := '0' *)
Twice := 2 * x;

END_FUNCTION


(* @NESTEDCOMMENTS := 'Yes' *)
(* @GLOBAL_VARIABLE_LIST := 'Global_Variables' *)
(* @PATH := '' *)
(* @OBJECTFLAGS := '0, 8' *)
VAR_GLOBAL
	Total: INT;
END_VAR
(* @OBJECT_END := 'Global_Variables' *)
(* @CONNECTIONS := Global_Variables
FILENAME : ''
FILETIME : 0
EXPORT : 0
NUMOFCONNECTIONS : 0
*)

VISUALISATION main _VISU_NO_BITMAP
_TEXT : 1
END_VISUALISATION
PLC_CONFIGURATION
_GLOBAL
_VERSION: 3
PLC_END
END
is((said("$ladder trace pump.EXP script"))[0] =~ s/^pump\.EXP:\d+:\d+: warning .*\n//mgr, <<'END', 'an export of CODESYS 2.3 runs');
1 t=10 Total=2 n=1 level=3
2 t=20 Total=6 n=2 level=6
3 t=30 Total=12 n=3 level=12
4 t=40 Total=20 n=4 level=24
END
like((said("$ladder check pump.EXP"))[0], qr{^pump\.EXP:46:1: warning LD\d+: "VISUALISATION"}m, 'what is no program is told');
like((said("$ladder check pump.EXP"))[0], qr{^pump\.EXP:49:1: warning LD\d+: "PLC_CONFIGURATION"}m, 'the configuration of the controller, too');
done_testing();
