# SPDX-License-Identifier: MIT
#
# FbdRandom - random programs in Function Block Diagram, from a seed, and what is set before their scans.
package FbdRandom;
use strict;
use warnings;

my $state;
sub below { my ($n) = @_; $state = ($state * 1103515245 + 12345) % 2147483648; int($state / 65536) % $n }
sub one { $_[below(scalar @_)] }

my %variables = (BOOL => [map { "B$_" } 1 .. 5], INT => [map { "N$_" } 1 .. 5], DINT => [map { "L$_" } 1 .. 3], REAL => [qw(Ra Rb Rc)],
		 WORD => [qw(Wa Wb)], TIME => [qw(Ta Tb)], STRING => [qw(Sa Sb)]);
my @types = qw(BOOL BOOL BOOL INT INT INT DINT REAL WORD TIME STRING);
my ($given, $wires, $outputs, $before, $instances, $memory, $inside);

my %blocks = (TON => [qw(IN PT)], TOF => [qw(IN PT)], TP => [qw(IN PT)], CTU => [qw(CU R PV)], SR => [qw(S1 R)], RS => [qw(S R1)],
	      R_TRIG => ['CLK'], Mix => [qw(A G)]);
my %gives = (TON => {Q => 'BOOL', ET => 'TIME'}, TOF => {Q => 'BOOL', ET => 'TIME'}, TP => {Q => 'BOOL', ET => 'TIME'}, CTU => {Q => 'BOOL', CV => 'INT'}, SR => {Q1 => 'BOOL'},
	     RS => {Q1 => 'BOOL'}, R_TRIG => {Q => 'BOOL'}, Mix => {O => 'INT', P => 'BOOL'});

sub constant {
	my ($type) = @_;
	return $type eq 'BOOL' ? one('TRUE', 'FALSE') : $type eq 'REAL' ? one('0.5', '1.25', '3.0') : $type eq 'TIME' ? one('T#10ms', 'T#35ms') :
		$type eq 'STRING' ? one("'ab'", "'x'", "'klm'") : $type eq 'WORD' ? one(1, 3, 255) : one(1, 2, 3, 7);
}

# Something that has a value already.
sub leaf {
	my ($type) = @_;
	my @wires = grep { $wires->{$_} eq $type } sort keys %$wires;
	return one(@wires) if @wires && below(2);
	my @outputs = grep { my ($i, $p) = split /\./; $gives{$instances->{$i}}{$p} eq $type } @$outputs;
	return one(@outputs) if @outputs && !below(4);
	return one(@{$variables{$type}});
}

sub some { my ($type, $depth) = @_; below(4) ? expression($type, $depth) : constant($type) }

sub compare {
	my ($depth) = @_;
	my $type = one(qw(INT DINT REAL TIME INT));
	my ($a, $b) = (expression($type, $depth), some($type, $depth));
	return '(' . $a . ' ' . one('<', '>', '<=', '>=', '=', '<>') . " $b)" if below(2);
	return one(qw(GT GE EQ LE LT)) . "($a, $b" . (below(3) ? '' : ', ' . some($type, $depth)) . ')';
}

sub more { my ($type, $depth) = @_; join '', map { ', ' . some($type, $depth) } 1 .. 1 + (below(3) ? 0 : below(15)) }

sub expression {
	my ($type, $depth) = @_;
	return leaf($type) if $depth <= 0 || !below(3);
	my $d = $depth - 1;
	my $way = below(10);
	if ($way == 0 && $type ne 'STRING') {
		return 'SEL(G := ' . expression('BOOL', $d) . ', IN0 := ' . expression($type, $d) . ', IN1 := ' . some($type, $d) . ')';
	}
	if ($type eq 'BOOL') {
		return compare($d) if $way < 3;
		return 'NOT ' . leaf('BOOL') if $way == 3;
		return one(qw(AND OR XOR)) . '(' . expression($type, $d) . more($type, $d) . ')' if $way == 4;
		return one(qw(R_EDGE F_EDGE)) . '(' . expression($type, $d) . ')' if $way == 5 && $memory;
		my @w = grep { $before->{$_} eq $type } sort keys %$before;
		return 'PREVIOUS(' . one(@w) . ')' if $way == 6 && @w;
		return '(' . expression($type, $d) . ' ' . one(qw(AND OR XOR)) . ' ' . expression($type, $d) . ')';
	}
	my @w = grep { $before->{$_} eq $type } sort keys %$before;
	return 'PREVIOUS(' . one(@w) . ')' if $way == 9 && @w;
	return 'MOVE(EN := ' . expression('BOOL', $d) . ', IN := ' . expression($type, $d) . ')' if $way == 8 && !below(3) && $inside;
	if ($type eq 'WORD') {
		return one(qw(SHL SHR ROL ROR)) . '(' . expression($type, $d) . ', ' . below(20) . ')' if $way < 4;
		return 'NOT ' . leaf($type) if $way == 4;
		return one(qw(AND OR XOR)) . '(' . expression($type, $d) . more($type, $d) . ')' if $way == 5;
		return '(' . expression($type, $d) . ' ' . one(qw(AND OR XOR)) . ' ' . expression($type, $d) . ')';
	}
	if ($type eq 'STRING') {
		return one(qw(LEFT RIGHT)) . '(' . expression($type, $d) . ', ' . below(5) . ')' if $way < 4;
		return 'CONCAT(' . leaf($type) . ', ' . some($type, 0) . ')';
	}
	return one(qw(MAX MIN)) . '(' . expression($type, $d) . more($type, $d) . ')' if $way == 1;
	return 'LIMIT(MN := ' . constant($type) . ', IN := ' . expression($type, $d) . ', MX := ' . expression($type, $d) . ')' if $way == 2;
	if ($type eq 'TIME') {
		return '(' . expression($type, $d) . ' + ' . constant($type) . ')';
	}
	if ($type eq 'REAL') {
		return 'INT_TO_REAL(' . expression('INT', $d) . ')' if $way == 3;
		return '(' . leaf($type) . ' * 0.5)' if $way < 6;
		return '(' . expression($type, $d) . one(' + ', ' - ') . some($type, $d) . ')';
	}
	return 'ADD(' . expression($type, $d) . more($type, $d) . ')' if $way == 3;
	return '(' . expression($type, $d) . one(' / ', ' MOD ') . leaf($type) . ')' if $way == 4;
	return 'ABS(' . expression($type, $d) . ')' if $way == 5;
	if ($type eq 'INT') {
		return 'DINT_TO_INT(' . expression('DINT', $d) . ')' if $way == 6;
		return 'LEN(' . expression('STRING', $d) . ')' if $way == 7 && !below(2);
		return 'Blend(X := ' . expression('INT', $d) . ', Y := ' . some('INT', $d) . ')' if $way == 7 && $inside;
		return 'MUX(' . one('N1', 'N2', 1) . ', ' . join(', ', map { expression('INT', 0) } 0 .. 1 + below(4)) . ')' if $way == 8;
	} else {
		return 'INT_TO_DINT(' . expression('INT', $d) . ')' if $way > 5;
	}
	return '(' . expression($type, $d) . one(' + ', ' - ', ' * ') . some($type, $d) . ')';
}

# A call of a function at the top of a value, with EN and ENO.
sub enabled {
	my ($type, $sure) = @_;
	my $eno = $sure ? ', ' . one('', 'NOT ') . "ENO => $sure" : '';
	return one(qw(ADD SUB MUL)) . '(EN := ' . expression('BOOL', 1) . ', IN1 := ' . expression($type, 1) . ', IN2 := ' . some($type, 1) . "$eno)";
}

sub network {
	my ($number, $labels, $off, $label) = @_;
	my $text = 'NETWORK' . ($off ? ' OFF' : '') . ($label ne '' ? " $label" : '') . (below(4) ? '' : " \"Number $number\"") . "\n";
	my $lines = 1 + below(7);
	my %later;
	($wires, $outputs, $given) = ({}, [], 0);
	my @plan;
	for my $i (1 .. $lines) {
		my $what = below(12);
		push @plan, $what < 5 ? ['wire', one(@types), "W$i"] : $what < 8 ? ['store', one(@types)] : $what == 8 ? ['latch'] :
			$what == 9 && $number < 90 ? ['leave'] : ['block'];
	}
	$before = {map { $_->[2] => $_->[1] } $memory ? grep { $_->[0] eq 'wire' } @plan : ()};
	for my $line (@plan) {
		my ($kind, $type, $name) = @$line;
		if ($kind eq 'wire' || $kind eq 'store') {
			my ($value, $sure) = ('', '');
			if ($type =~ /INT/ && !below(3)) {
				$sure = !below(2) ? '' : below(2) ? one(@{$variables{BOOL}}) : 'Sure' . substr($name // 'W0', 1);
				$sure = '' if $sure =~ /^Sure/ && exists $wires->{$sure};
				$value = enabled($type, $sure);
			} else {
				$value = expression($type, 3);
			}
			# A wire whose value goes round alone would have no type.
			$value = $type eq 'BOOL' ? '(' . one(@{$variables{$type}}) . " XOR $value)" :
				'SEL(G := ' . leaf('BOOL') . ', IN0 := ' . one(@{$variables{$type}}) . ", IN1 := $value)"
				if $kind eq 'wire' && $value =~ /PREVIOUS/;
			$text .= '  ' . ($kind eq 'wire' ? $name : one(@{$variables{$type}})) . " := $value" . (below(8) ? '' : '  // why not') . "\n";
			$wires->{$name} = $type if $kind eq 'wire';
			$wires->{$sure} = 'BOOL' if $sure =~ /^Sure/;
		} elsif ($kind eq 'latch') {
			$text .= '  ' . one(@{$variables{BOOL}}) . ' ' . one('S', 'R') . '= ' . expression('BOOL', 2) . "\n";
		} elsif ($kind eq 'leave') {
			$text .= @$labels && below(4) ? '  JMP ' . one(@$labels) . ' IF ' . expression('BOOL', 2) . "\n" :
				'  RETURN IF ' . join(' AND ', map { leaf('BOOL') } 1 .. 4) . "\n";
		} elsif ($inside) {
			my $i = one(sort keys %$instances);
			my $block = $instances->{$i};
			my @pins = grep { $_ eq 'PT' || below(5) } @{$blocks{$block}};
			my @bits = grep { $gives{$block}{$_} eq 'BOOL' } sort keys %{$gives{$block}};
			my $to = !@bits || below(2) ? '' : below(2) ? one(@{$variables{BOOL}}) : 'Given' . ++$given;
			my $gives = $to ? [one('', 'NOT ') . one(@bits) . " => $to"] : [];
			$text .= "  $i(" . join(', ', (below(5) ? () : 'EN := ' . expression('BOOL', 1)),
				(map { my $t = $_ eq 'PT' ? 'TIME' : /^(?:PV|A)$/ ? 'INT' : 'BOOL';
				      "$_ := " . ($t eq 'TIME' && !below(3) ? one('T#10ms', 'T#25ms', 'T#35ms') : expression($t, 2)) } @pins), @$gives) . ")\n";
			$wires->{$to} = 'BOOL' if $to =~ /^Given/;
			push @$outputs, map { "$i.$_" } keys %{$gives{$block}};
			@$outputs = sort @$outputs;
		}
	}
	# Nobody warns of wires that are read; all names of the program stay in use by the test.
	return $text;
}

sub declarations {
	my ($only) = @_;
	my $text = "VAR\n";
	for my $type (sort keys %variables) {
		$text .= "  $_ : $type" . ($type eq 'STRING' ? '[20]' : '') .
			(below(2) ? '' : ' := ' . ($type =~ /INT/ && !below(3) ? one(32767, 32000) : constant($type))) . ";\n" for @{$variables{$type}};
	}
	return $text . join('', map { "  $_ : $instances->{$_};\n" } sort keys %$instances) . "END_VAR\n";
}

my $own = <<'END';
FUNCTION Blend : INT FBD
VAR_INPUT
  X : INT;
  Y : INT;
END_VAR
NETWORK
  Half := (X / 2)
  Most := MAX(Half, Y)
  Blend := Most
NETWORK
  RETURN IF (X < Y)
  Blend := (Y - X)
END_FUNCTION
FUNCTION_BLOCK Mix FBD
VAR_INPUT
  A : INT;
  G : BOOL;
END_VAR
VAR_OUTPUT
  O : INT;
  P : BOOL;
END_VAR
VAR
  Delay : TON;
END_VAR
NETWORK
  Sum := (PREVIOUS(Sum) + SEL(R_EDGE(G), 0, A))
  Delay(IN := (Sum > 5), PT := T#20ms)
  O := Sum
NETWORK Last
  P := (Delay.Q XOR F_EDGE(G))
END_FUNCTION_BLOCK
END

sub program {
	my ($seed, $networks) = @_;
	$state = ($seed * 7919 + 17) % 2147483648;
	below(2) for 1 .. 5;
	$instances = {Ton1 => 'TON', Ton2 => 'TON', Tof1 => 'TOF', Tp1 => 'TP', Ctu1 => 'CTU', Sr1 => 'SR', Rs1 => 'RS', Trig1 => 'R_TRIG', Mix1 => 'Mix', Mix2 => 'Mix'};
	($memory, $inside) = (1, 1);
	my $text = "RUNGBOARD 1\n\n${own}PROGRAM Main FBD\n" . declarations();
	my @labels = map { below(3) ? '' : "Go$_" } 1 .. $networks;
	for my $n (1 .. $networks) {
		$text .= network($n, [grep { $_ ne '' } @labels[$n .. $#labels]], !below(12), $labels[$n - 1]);
	}
	return $text . "END_PROGRAM\n";
}

# What is set before a scan: [name, value].
sub inputs {
	return map { my $type = one(@types); [one(@{$variables{$type}}), $type eq 'BOOL' ? below(2) : $type eq 'STRING' ? substr("'abcdefg", 0, 1 + below(6)) . "'" :
		$type eq 'REAL' ? one('0.5', '2.25', '-1.5') : $type eq 'TIME' ? one(0, 15, 40) : $type eq 'WORD' ? below(65536) :
		$type eq 'INT' ? one(0, 1, 2, -3, 32767, -32768, below(100)) : one(0, 1, -5, 100000, 2147483647)] } 1 .. 1 + below(5);
}

sub names { return map { my $type = $_; map { [$_, $type] } @{$variables{$type}} } sort keys %variables }

1;
