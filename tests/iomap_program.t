#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# iomap_program.t - `ladder check --io MAP` warns (LD515) about every input and output
# that a program uses without a line: each area, each width, in each kind of text, with
# and without a name. Markers and addresses with a line give no warning.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use JSON::PP;
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $tests = abs_path(dirname(__FILE__));
my $build = $ENV{BUILD} // "$tests/../build";
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);

my @inputs = qw(I AI XI XAI);
my @outputs = qw(Q AQ XQ XAQ);
my @memory = qw(M V S);
my %type = (X => 'BOOL', B => 'BYTE', W => 'WORD', D => 'DWORD', L => 'LWORD');
my @widths = sort keys %type;

sub put {
	my ($name, $text) = @_;
	open my $file, '>', "$folder/$name" or die;
	print $file $text;
	close $file or die;
	return "$folder/$name";
}

# What `ladder check` finds missing in the map, in alphabetical order.
sub missing {
	my ($text, $map, $what) = @_;
	my $rung = put('main.rung', $text);
	my $io = put('main.io', $map);
	my $json = `$ladder check --json --io $io $rung`;
	my $result = decode_json($json)->[0];
	ok($result->{good}, "$what: the program is good") or diag $json;
	return join ' ', sort map $_->{arg},
	       grep { $_->{code} eq 'LD515' } @{$result->{diagnostics}};
}

# A different place for each width, so that no address covers another one.
my %byte = (X => 0, B => 1, W => 2, D => 4, L => 8);
sub address { my ($area, $width) = @_; "%$area$width$byte{$width}" . ($width eq 'X' ? '.3' : '') }

sub rungs { join '', map "RUNG\n  $_\n", @_ }
sub program {
	my ($globals, $language, $body) = @_;
	return "RUNGBOARD 1\n\nVAR_GLOBAL\n$globals" .
	       join('', map "  Any$_ : $type{$_};\n", @widths) .
	       "END_VAR\n\nPROGRAM Main $language\n${body}END_PROGRAM\n";
}

# A statement that reads or writes the operand. Each form is another instruction.
my %read = (
	cell => sub { my ($at, $w) = @_;
		$w eq 'X' ? "| NO $at | COIL AnyX |" : "| [ $at <> Any$w ] | COIL AnyX |" },
	expression => sub { my ($at, $w) = @_; "| [ Any$w := $at ] |" },
	function => sub { my ($at, $w) = @_;
		"| SEL G:=AnyX IN0:=$at IN1:=Any$w OUT=>Any$w |" },
	box => sub { my ($at, $w) = @_; "| MOVE IN:=$at OUT=>Any$w |" },
);
my %write = (
	cell => sub { my ($at, $w) = @_;
		$w eq 'X' ? "| NO AnyX | COIL $at |" : "| NO AnyX | MOVE IN:=Any$w OUT=>$at |" },
	expression => sub { my ($at, $w) = @_; "| [ $at := Any$w ] |" },
	function => sub { my ($at, $w) = @_;
		"| SEL G:=AnyX IN0:=Any$w IN1:=Any$w OUT=>$at |" },
	box => sub { my ($at, $w) = @_; "| MOVE IN:=Any$w OUT=>$at |" },
);

my $other = "BOARD \"x\"\n%IX100.0 sim\n%QX100.0 sim\n";
my @all = map { my $area = $_; map address($area, $_), @widths } @inputs, @outputs;
for my $form (sort keys %read) {
	my (@by_address, @by_name, $globals, @names);
	for my $area (@inputs, @outputs, @memory) {
		for my $w (@widths) {
			my $say = (grep { $_ eq $area } @inputs) ? $read{$form} : $write{$form};
			my $at = address($area, $w);
			push @by_address, $say->($at, $w);
			push @by_name, $say->("My$area$w", $w);
			$globals .= "  My$area$w AT $at : $type{$w};\n";
			push @names, "My$area$w" unless grep { $_ eq $area } @memory;
		}
	}
	is(missing(program('', 'LD', rungs(@by_address)), $other, $form),
	   join(' ', sort @all), "$form: each address is missing");
	is(missing(program($globals, 'LD', rungs(@by_name)), $other, $form),
	   join(' ', sort @names), "$form: each name is missing");
}
is(missing(program('', 'IL',
		   join '', map({ my $a = $_; map "  LD  " . address($a, $_) . "\n  ST  Any$_\n", @widths } @inputs),
			    map({ my $a = $_; map "  LD  Any$_\n  ST  " . address($a, $_) . "\n", @widths } @outputs)),
	   $other, 'list'), join(' ', sort @all), 'list: each address is missing');

is(missing(program('', 'ST',
		   join '', map({ my $a = $_; map "  Any$_ := " . address($a, $_) . ";\n", @widths } @inputs),
			    map({ my $a = $_; map '  ' . address($a, $_) . " := Any$_;\n", @widths } @outputs)),
	   $other, 'statements'), join(' ', sort @all), 'statements: each address is missing');
# The daemon says the same when it loads the program, also from a code image without names.
my $image = "$folder/main.code";
ok(!system("$ladder build -o $image $folder/main.rung"), 'a code image');
for my $file ("$folder/main.rung", $image) {
	my $told = `$build/ladderd $file --io $folder/main.io --check 2>&1`;
	is(join(' ', sort $told =~ /LD515: "([^"]+)"/g), join(' ', sort @all), "ladderd: $file");
}

# With a line: the bit, and a wider value with a line for one of its bits.
my $lines = "BOARD \"x\"\n" .
	    join '', map { my $area = $_; map "%${area}X$byte{$_}.3 sim\n", @widths } 'I', 'Q';
my @some = grep { !/^%[IQ]/ } @all;
is(missing(program('', 'LD', rungs(
	(map { my $a = $_; map $read{box}->(address($a, $_), $_), @widths } @inputs),
	(map { my $a = $_; map $write{box}->(address($a, $_), $_), @widths } @outputs))),
	   $lines, 'lines'), join(' ', sort @some), 'an address with a line gives no warning');

# Elements, and a computed index.
is(missing(program("  Index : INT;\n  Row AT %AIW20 : ARRAY[1..2] OF WORD;\n", 'LD', rungs(
	'| [ AnyW := %XAIW6[Index] ] | [ %AQW4[Index] := AnyW ] | [ AnyW := Row[Index] ] |',
	'| [ AnyX := %XIX3.1[Index] ] |')), $other, 'indices'),
   '%AQW4 %XAIW6 %XIX3.1 Row[1] Row[2]', 'an index: the address, or each element');
# An address is named once.
is(missing(program('', 'LD', rungs(('| NO %XIX0.0 | NO %IX9.0 | [ %AIW0 > AnyW ] | COIL %QX0.0 |') x 3)),
	   $other, 'again'), '%AIW0 %IX9.0 %QX0.0 %XIX0.0', 'each address once');

# Outputs without safe=: once for a map, at the first one.
for my $case (['%QX0.0 sim safe=0', undef], ['%QX0.0 sim safe=hold', undef], ["%QX0.0 sim safe=1\n%QX0.1 sim", '%QX0.1', 4],
	[join("\n", "%QX0.0 sim", map { "%QX1.$_ sim" } 0 .. 7), '%QX0.0', 3]) {
	my ($outputs, $want, $line) = @$case;
	missing(program('', 'LD', rungs('| NO %IX0.0 | COIL %QX0.0 |')), "BOARD \"x\"\n%IX0.0 sim\n$outputs\n", 'safe');
	my @said = grep { /LD030/ } split /\n/, `$ladder check --io $folder/main.io $folder/main.rung 2>&1`;
	is(scalar @said, defined $want ? 1 : 0, 'what is off without being told so is told once');
	like($said[0], qr/main\.io:$line:1: warning LD030: "\Q$want\E" has no safe=, so it is off while no program runs/, 'with its place') if $want;
	unlike($said[0], qr/other outputs/, 'alone') if $want && $line == 4;
	like($said[0], qr/, as are other outputs: 8; write safe=0, safe=1 or safe=hold$/, 'and how many more') if $want && $line == 3;
}

# Blocks that ask: by their name, with or without that of their program, in any case; one of the right kind, once.
for my $case (['Meter', ''], ['main.METER', ''], ['Drive', 'LD548'], ['Other', 'LD548'], ['Meter.BUSY', 'LD548'], ['Twice', 'LD548'],
	['Side.Twice', ''], ['Meter modbus', ''], ['Main.Meter again', 'LD549']) {
	my ($name, $want) = @$case;
	my $lines = "BOARD \"x\"\nBUS p modbus-tcp host=h\n%IW0 modbus bus=p unit=1 holding-register=0 ask=" . $name =~ s/ .*//r . "\n";

	$lines .= "%IW2 modbus bus=p unit=1 holding-register=1 ask=Meter\n" if $name =~ / again/;
	put('main.io', $lines);
	put('main.rung', "RUNGBOARD 1\n\nPROGRAM Main ST\nVAR\n  Meter : MB_READ;\n  Drive : MB_WRITE;\n  Twice : MB_READ;\nEND_VAR\n" .
		"  Meter(REQ := %MX0.0);\n  Drive(REQ := %MX0.0);\n  Twice(REQ := %MX0.0);\n  %MW2 := %IW0;\nEND_PROGRAM\n\n" .
		"PROGRAM Side ST\nVAR\n  Twice : MB_READ;\nEND_VAR\n  Twice(REQ := %MX0.0);\nEND_PROGRAM\n");
	my @said = grep { /error/ } split /\n/, `$ladder check --io $folder/main.io $folder/main.rung 2>&1`;
	like($said[0] // '', $want ? qr/main\.io:[34]:45: error $want: / : qr/^$/, "ask=$name");
}

my $text = `$ladder check --io $folder/none.io $folder/main.rung 2>&1`;
is($? >> 8, 2, 'a map that cannot be read');
put('bad.io', "BOARD \"x\"\n%QX0.0 sim fast\n");
$text = `$ladder check --io $folder/bad.io $folder/main.rung 2>&1`;
is($? >> 8, 1, 'a map with an error');
like($text, qr/bad\.io:2:12: error LD504: .*main\.rung: 1 error/s, 'is an error of the check');
done_testing;
