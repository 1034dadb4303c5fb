# SPDX-License-Identifier: MIT
#
# RandomProject - random projects in all five languages, with all kinds of declarations. Others feed the inputs In1 …
# In4 and look at what RandomProject::printed() names.
package RandomProject;
use strict;
use warnings;

sub one_of { return $_[rand @_] }
sub maybe { my ($share, $text) = @_; return rand() < $share ? $text : '' }

# ---- declarations ----
my %literal = (
	BOOL => sub { one_of(qw(TRUE FALSE)) }, SINT => sub { int(rand 200) - 100 }, INT => sub { one_of(int(rand 900) - 400, '16#1F') }, DINT => sub { int(rand 90000) - 40000 },
	LINT => sub { int rand 5e9 }, USINT => sub { int rand 250 }, UINT => sub { int rand 60000 }, UDINT => sub { int rand 4e9 }, ULINT => sub { int rand 9e9 },
	BYTE => sub { sprintf '16#%X', rand 256 }, WORD => sub { sprintf '16#%X', rand 65536 }, DWORD => sub { sprintf '16#%X', rand 2**32 }, LWORD => sub { sprintf '16#%X', rand 2**40 },
	REAL => sub { sprintf '%.2f', rand(20) - 10 }, LREAL => sub { sprintf '%.3f', rand(20) - 10 },
	TIME => sub { one_of('T#1s500ms', 'T#20ms', 'T#2h', 'T#0s') }, TOD => sub { 'TOD#12:34:56' }, DATE => sub { 'D#2026-03-01' }, DT => sub { 'DT#2026-03-01-12:00:00' },
	STRING => sub { one_of("'a'", "'it\$'s <b> & \"c\"'", "''", "']]>'", "'\x{c3}\x{a4}'") },
);
my @types = sort keys %literal;
my @numbers = qw(SINT INT DINT UINT REAL);

# A declaration; the name gets its type in %$all.
sub declared {
	my ($all, $name, $kinds) = @_;
	my $comment = maybe(0.3, ' ' . one_of('(* level <of> all *)', '// one & two', '(* ]]> *)'));
	my $kind = rand;
	if ($kinds && $kind < 0.4) {
		my ($type, $value) = @{one_of(
			['Color', one_of('Red', 'Color#Green', 'Blue')], ['Percent', int rand 100], ['Speed', sprintf '%.1f', rand 9], ['Part', one_of('(Size := 3)', '(Size := 4, Name := \'x\')', '')],
			['ARRAY[1..3] OF INT', one_of('[1, 2, 3]', '[2(7), 1]', '')], ['ARRAY[0..1, -1..1] OF BOOL', one_of('[6(TRUE)]', '')], ['ARRAY[1..2] OF Part', one_of('[(Size := 1), (Size := 2)]', '')],
			['STRING[12]', one_of("'short'", '')], ['Table', one_of('[1.0, 2.0]', '')], ['INT (0..20)', int rand 20], ['TON', ''], ['ARRAY[1..2] OF CTU', ''])};
		return "  $name : $type" . ($value ne '' && rand() < 0.7 ? " := $value" : '') . ";$comment\n";
	}
	my $type = one_of(@types);
	$all->{$name} = $type;
	return "  $name : $type" . maybe(0.5, ' := ' . $literal{$type}->()) . ";$comment\n";
}

sub block {
	my ($all, $word, $stem, $kinds) = @_;
	my %fixed;
	my $constant = $word =~ /CONSTANT/;
	my $text = join '', map {
		my $line = declared($constant ? \%fixed : $all, "$stem$_", $kinds && !$constant);
		$constant && $line !~ /:=/ ? $line =~ s/ : (\w+);/" : $1 := " . $literal{$1}->() . ';'/er : $line;
	} 1 .. 1 + int rand 3;
	return "$word\n${text}END_VAR\n";
}

# ---- bodies; all of them know In1 … (BOOL), Bit1 … (BOOL) and Num1 … (INT) ----
my @in = map { "In$_" } 1 .. 4;
my @bit = map { "Bit$_" } 1 .. 4;
my @num = map { "Num$_" } 1 .. 3;
sub condition {
	my ($depth) = @_;
	return one_of(one_of(@in, @bit), 'NOT ' . one_of(@in, @bit), one_of(@num) . one_of(' > ', ' <= ', ' = ', ' <> ') . int(rand 9)) if !$depth || rand() < 0.4;
	return '(' . condition($depth - 1) . one_of(' AND ', ' OR ', ' XOR ') . condition($depth - 1) . ')';
}
sub amount {
	my ($depth) = @_;
	return one_of(one_of(@num), int rand 9) if !$depth || rand() < 0.4;
	return one_of('(' . amount($depth - 1) . one_of(' + ', ' - ', ' * ') . amount($depth - 1) . ')', 'MAX(' . amount($depth - 1) . ', ' . amount($depth - 1) . ')',
		'SEL(' . condition(0) . ', ' . amount(0) . ', ' . amount(0) . ')', 'LIMIT(-50, ' . amount($depth - 1) . ', 50)', 'TwiceOf(X := ' . amount(0) . ')');
}
sub statement {
	my ($depth, $indent) = @_;
	my $n = rand;
	my $own = sub { statement($depth - 1, "$indent  ") };
	return "$indent" . one_of(@bit) . ' := ' . condition(2) . ";\n" if $n < 0.35 || !$depth;
	return "$indent" . one_of(@num) . ' := ' . amount(2) . ';' . maybe(0.2, ' // <why> & how') . "\n" if $n < 0.6;
	return "${indent}Wait(IN := " . condition(1) . ", PT := T#30ms);\n$indent" . one_of(@bit) . " := Wait.Q;\n" if $n < 0.7;
	return "${indent}IF " . condition(1) . " THEN\n" . $own->() . "${indent}ELSIF " . condition(1) . " THEN\n" . $own->() . "${indent}ELSE\n" . $own->() . "${indent}END_IF;\n" if $n < 0.8;
	return "${indent}CASE " . one_of(@num) . " OF\n$indent  1, 2:\n" . $own->() . "$indent  3..5:\n" . $own->() . "${indent}ELSE\n" . $own->() . "${indent}END_CASE;\n" if $n < 0.88;
	return "${indent}FOR Num3 := 1 TO 3 DO\n$indent  " . one_of(@num[0, 1]) . " := LIMIT(-99, Num1 + Num3, 99);\n${indent}END_FOR;\n" if $n < 0.94;
	return "${indent}Arr[LIMIT(0, " . one_of(@num) . ", 3)] := " . amount(1) . ";\n$indent" . one_of(@num) . " := Arr[" . int(rand 4) . "] + 1;\n" if $n < 0.96;
	return "${indent}Num3 := 0;\n${indent}WHILE Num3 < 4 DO\n$indent  Num3 := Num3 + 1;\n$indent  IF " . condition(0) . " THEN\n$indent    " . one_of('EXIT', 'CONTINUE') . ";\n$indent  END_IF;\n$indent  " . one_of(@bit) . ' := ' . condition(1) . ";\n${indent}END_WHILE;\n" if $n < 0.97 && $depth > 1;
	return "${indent}IF " . condition(0) . " THEN\n$indent  RETURN;\n${indent}END_IF;\n" if $n < 0.98 && $indent eq '  ';
	return "${indent}Box(Run := " . condition(0) . ", Step := " . amount(0) . ", Sum => Num2);\n";
}
sub st { return join '', map { statement(2, '  ') } 1 .. 1 + int rand 4 }
sub il {
	return join '', map { one_of(
		sub { '  LD' . one_of('', 'N') . '   ' . one_of(@in) . "\n  " . one_of('AND', 'OR', 'XOR', 'ANDN', 'ORN') . '  ' . one_of(@bit) . "\n  " . one_of('ST', 'STN', 'S', 'R') . '  ' . one_of(@bit) . "\n" },
		sub { '  LD   ' . one_of(@num) . "\n  ADD  " . int(rand 5) . "\n  " . one_of('MUL  2', 'SUB  1') . "\n  ST   " . one_of(@num) . "\n" },
		sub { '  LD   ' . one_of(@num) . "\n  " . one_of(qw(GT GE EQ NE LE LT)) . '   ' . int(rand 5) . "\n  ST   " . one_of(@bit) . "\n" },
		sub { "  CAL  Wait(IN := " . one_of(@in) . ", PT := T#20ms)\n  LD   Wait.Q\n  ST   " . one_of(@bit) . "\n" })->() } 1 .. 1 + int rand 4;
}
sub contact {
	my ($wait) = @_;
	return one_of('NO ', 'NC ', 'NO ', 'NC ', 'P ', 'N ') . one_of(@in) if rand() < 0.6;
	return one_of('NO ', 'NC ') . one_of(@bit) if rand() < 0.6;
	return '[ ' . one_of(@num) . ' > ' . int(rand 6) . ' ]' if rand() < 0.6;
	return !$$wait++ ? 'TON Wait PT:=T#30ms' : 'NOT';
}
sub rungs {
	my $wait = 0;
	my $count = 1 + int rand 3;
	return join '', map {
		my $width = 1 + int rand 3;
		my @row = (join(' | ', map({ contact(\$wait) } 1 .. $width), one_of('COIL ', 'COILNOT ', 'S ', 'R ') . one_of(@bit)));
		$row[0] =~ s/\| [^|]*$/'| ' . one_of('[ Num1 := Num1 + 1 ]', '[ Num2 := Num1 * 2 ]', 'MOVE IN:=Num1 OUT=>Num2')/e if rand() < 0.2;
		push @row, join(' | ', map { contact(\$wait) } 1 .. $width) . ' ^' if rand() < 0.4;
		@row = (join(' | ', map { contact(\$wait) } 1 .. $width) . one_of(' | EXECUTE Lines | COIL Bit1', " | JMP Label" . ($_ + 1), ' | Adder Box Step:=Num1 Sum=>Num2')) if rand() < 0.4 && $_ < $count;
		"RUNG" . maybe(0.1, ' OFF') . ($_ > 1 ? " Label$_" : '') . maybe(0.4, ' "' . one_of('A title', 'x < y & z') . '"') . "\n" . join('', map { "  | $_ |\n" } @row) . ("@row" =~ /EXECUTE/ ? "  EXECUTE Lines:\n" . st() =~ s/^/  /gmr . "  END_EXECUTE\n" : '');
	} 1 .. $count;
}
sub networks {
	my ($wait, $wire, $box) = (0, 0, 0);
	my $count = 1 + int rand 3;
	return join '', map { my $here = $_; 'NETWORK' . maybe(0.1, ' OFF') . ($here > 1 ? " Label$here" : '') . maybe(0.4, ' "A title <b>"') . "\n" . join('', map { one_of(
		sub { '  ' . one_of(@bit) . ' := ' . condition(2) . "\n" }, sub { '  ' . one_of(@num) . ' := ' . amount(2) . "\n" },
		sub { my $w = 'W' . ++$wire; "  $w := SEL(" . condition(0) . ', ' . int(rand 9) . ', ' . amount(0) . ")\n  Num1 := $w\n  Num2 := LIMIT(-40, $w + Num3, 40)\n" },
		sub { my $w = 'W' . ++$wire; "  $w := " . condition(1) . "\n  Bit1 := $w\n  Bit2 := NOT $w AND " . condition(0) . "\n" },
		sub { my $w = 'W' . ++$wire; "  $w := SEL(" . condition(0) . ", 2, 7)\n  Num3 := $w\n" },
		sub { $box++ ? '' : '  Box(Run := ' . condition(0) . ', Step := ' . amount(0) . ")\n  " . one_of(@num) . " := Box.Sum\n" },
		sub { '  ' . one_of(@bit) . one_of(' S= ', ' R= ') . condition(1) . "\n" }, sub { '  ' . one_of(@bit) . ' := ' . one_of('R_EDGE(', 'F_EDGE(') . one_of(@in) . ")\n" },
		sub { $wait++ ? '  ' . one_of(@num) . " := ADD(EN := " . condition(0) . ', IN1 := ' . one_of(@num) . ", IN2 := 1)\n" : '  Wait(IN := ' . condition(1) . ", PT := T#30ms)\n  " . one_of(@bit) . " := Wait.Q\n" })->()
		} 1 .. 1 + int rand 2) . ($here < $count ? maybe(0.3, '  JMP Label' . ($here + 1) . ' IF ' . condition(1) . "\n") : '') } 1 .. $count;
}
sub chart {
	my @more = map { one_of('N', 'P1', 'P0', 'S', 'R', 'P', 'L, T#30ms', 'D, T#20ms') } 1 .. 3;
	return "  INITIAL_STEP A:\n    Act1($more[0]);\n  END_STEP\n\n  STEP B:\n    Act2($more[1]);\n" . maybe(0.5, "    Bit4($more[2]);\n") . "  END_STEP\n\n" . maybe(0.4, "  STEP C:\n  END_STEP\n\n")
		. '  TRANSITION' . maybe(0.3, ' Go') . ' FROM A TO B := ' . condition(1) . "; END_TRANSITION\n  TRANSITION FROM B TO A := " . condition(1) . "; END_TRANSITION\n\n"
		. "  ACTION Act1:\n" . st() . "  END_ACTION\n\n  ACTION Act2:\n" . st() . "  END_ACTION\n";
}
my %body = (ST => \&st, IL => \&il, LD => \&rungs, FBD => \&networks, SFC => \&chart);

# ---- projects ----
sub head { my ($text) = @_; return maybe(0.3, one_of("(* what <it> does *)\n", "// one line\n")) . $text }
sub program {
	my ($name, $language, $all) = @_;
	my %own;
	my $text = head("PROGRAM $name $language\n") . block(\%own, one_of('VAR', 'VAR RETAIN', 'VAR CONSTANT', 'VAR_TEMP'), lc "${name}_v", 1)
		. "VAR\n  Wait : TON;\n  Box : Adder;\nEND_VAR\n";
	$all->{"$name.$_"} = $own{$_} for $text =~ /VAR_TEMP/ ? () : keys %own;
	return $text . $body{$language}->() . "END_PROGRAM\n\n";
}
sub project {
	my %all;
	my %place = map { $_ => rand } sort keys %body;
	my @languages = sort { $place{$a} <=> $place{$b} } sort keys %body;
	my @programs = map { ["Main$_", $languages[$_ - 1]] } 1 .. 1 + int rand 3;
	my $text = "RUNGBOARD 1\n" . maybe(0.3, "PROJECT \"A <name> & more\"\n") . "\nTYPE\n  Color : (Red, Green := 5, Blue);\n  Percent : INT (0..100)" . maybe(0.5, ' := 7') . ";\n  Speed : REAL" . maybe(0.5, ' := 2.5') . ";\n"
		. "  Table : ARRAY[1..2] OF REAL;\n  Part : STRUCT\n    Size : INT" . maybe(0.5, ' := 9') . ";\n    Name : STRING[8];\n    Flags : ARRAY[0..2] OF BOOL;\n  END_STRUCT;\nEND_TYPE\n\n"
		. "VAR\n" . join('', map { "  $in[$_] AT %IX0.$_ : BOOL;\n" } 0 .. $#in) . join('', map { "  $bit[$_]" . maybe(0.3, " AT %QX0.$_") . " : BOOL;\n" } 0 .. $#bit) . join('', map { "  $num[$_]" . maybe(0.3, ' AT %MW' . 2 * $_) . " : INT;\n" } 0 .. $#num) . "  Arr : ARRAY[0..3] OF INT;\nEND_VAR\n\n"
		. block(\%all, one_of('VAR', 'VAR RETAIN', 'VAR CONSTANT'), 'glob', 1) . "\n"
		. head("FUNCTION TwiceOf : INT ST\nVAR_INPUT\n  X : INT;\nEND_VAR\n  TwiceOf := LIMIT(-30, X * 2, 30);\nEND_FUNCTION\n\n")
		. head("FUNCTION_BLOCK Adder ST\nVAR_INPUT\n  Run : BOOL" . maybe(0.3, ' := TRUE') . ";\n  Step : INT := 1;\nEND_VAR\nVAR_OUTPUT\n  Sum : INT;\nEND_VAR\nVAR\n  Was : BOOL;\nEND_VAR\n  IF Run AND NOT Was THEN\n    Sum := LIMIT(-99, Sum + Step, 99);\n  END_IF;\n  Was := Run;\nEND_FUNCTION_BLOCK\n\n")
		. join('', map { program(@$_, \%all) } @programs);
	if (rand() < 0.6) {
		$text .= "CONFIGURATION Plant\n" . maybe(0.5, "  TASK Fast (INTERVAL := T#10ms, PRIORITY := 1);\n") . maybe(0.2, "  RESOURCE Cpu ON Arm\n");
		$text .= "  TASK Slow (INTERVAL := T#20ms, PRIORITY := 5);\n" . join('', map { "  PROGRAM Run_$_->[0] WITH Slow : $_->[0];\n" } @programs);
		$text .= "  END_RESOURCE\n" if $text =~ /RESOURCE Cpu/;
		$text .= "END_CONFIGURATION\n";
	}
	return ($text, \%all);
}

# The names whose values a trace prints.
sub printed { my ($all) = @_; return (@bit, @num, sort keys %$all) }

# A script of $scans scans with random inputs.
sub script {
	my ($all, $scans) = @_;
	return '@print ' . join(' ', printed($all)) . "\n" . join '', map { join(' ', map { "$_=" . int rand 2 } @in) . "\n" } 1 .. $scans;
}

1;
