# SPDX-License-Identifier: MIT
#
# FbdFlow - a second reading of Function Block Diagrams, for tests: it parses the text by itself and walks a
# network as a graph, from what is wanted back to what that needs.
#
# A line is a node. Its value is asked for by the lines that use it; a line behind a JMP or RETURN asks first
# whether that was taken. The last line is asked first. Types are BOOL INT DINT REAL WORD TIME STRING.
package FbdFlow;
use strict;
use warnings;
use POSIX ();

my %low = (INT => -32768, DINT => -2147483648);
my %span = (INT => 65536, DINT => 4294967296);
my $token = qr/\G\s*(?:(T\#\d+ms)|(\d+\.\d+)|(\d+)|('[^']*')|([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*)|(:=|=>|<>|<=|>=|[-+*\/(),<>=]))/;

sub float { unpack 'f', pack 'f', $_[0] }

# ---- parser ----

sub tokens {
	my ($text) = @_;
	my @list;
	while ($text =~ /$token/gc) {
		push @list, defined $1 ? ['TIME', substr($1, 2) =~ s/ms//r] : defined $2 ? ['REAL', $2] :
			defined $3 ? ['NUM', $3] : defined $4 ? ['STRING', substr $4, 1, -1] :
			defined $5 ? ['NAME', $5] : ['SIGN', $6];
	}
	$text =~ /\G\s*\z/gc or die "cannot read: $text";
	return \@list;
}

my @levels = (['OR'], ['XOR'], ['AND'], ['=', '<>'], ['<', '>', '<=', '>='], ['+', '-'], ['*', '/', 'MOD']);

sub is { my ($p, $word) = @_; @{$p->{list}} && $p->{list}[0][1] eq $word && $p->{list}[0][0] =~ /NAME|SIGN/ }
sub accept_ { my ($p, $word) = @_; is($p, $word) ? shift @{$p->{list}} : undef }

sub parse_two {
	my ($p, $level) = @_;
	return parse_one($p) if $level == @levels;
	my $left = parse_two($p, $level + 1);
	while (my ($op) = grep { is($p, $_) } @{$levels[$level]}) {
		shift @{$p->{list}};
		$left = {kind => 'two', op => $op, arg => [$left, parse_two($p, $level + 1)]};
	}
	return $left;
}

sub parse_args {
	my ($p) = @_;
	my (@in, @out);
	until (accept_($p, ')')) {
		my ($pin, $sign) = ('', '');
		my $not = @{$p->{list}} > 2 && $p->{list}[0][1] eq 'NOT' && $p->{list}[2][1] eq '=>' && shift @{$p->{list}};
		if (@{$p->{list}} > 1 && $p->{list}[0][0] eq 'NAME' && $p->{list}[1][1] =~ /^(?::=|=>)$/) {
			$pin = shift(@{$p->{list}})->[1];
			$sign = shift(@{$p->{list}})->[1];
		}
		if ($sign eq '=>') {
			push @out, [$pin, shift(@{$p->{list}})->[1], $not ? 1 : 0];
		} else {
			push @in, [$pin, parse_two($p, 0)];
		}
		accept_($p, ',');
	}
	return (\@in, \@out);
}

sub parse_one {
	my ($p) = @_;
	return {kind => 'not', arg => [parse_one($p)]} if accept_($p, 'NOT');
	if (accept_($p, '(')) {
		my $inner = parse_two($p, 0);
		accept_($p, ')') or die ') is missing';
		return $inner;
	}
	my $t = shift @{$p->{list}};
	return {kind => 'constant', type => $t->[0] eq 'NUM' ? '' : $t->[0],
		value => $t->[0] eq 'REAL' ? float($t->[1]) : $t->[0] eq 'STRING' ? $t->[1] : 0 + $t->[1]}
		if $t->[0] ne 'NAME';
	return {kind => 'constant', type => 'BOOL', value => $t->[1] eq 'TRUE' ? 1 : 0} if $t->[1] =~ /^(?:TRUE|FALSE)$/;
	return {kind => 'name', name => $t->[1]} unless accept_($p, '(');
	my ($in, $out) = parse_args($p);
	return {kind => 'call', name => $t->[1], in => $in, out => $out, memory => \my $unused};
}

sub parse_line {
	my ($text) = @_;
	my %line;
	if ($text =~ s/^JMP (\w+)//) {
		%line = (kind => 'jump', label => $1);
	} elsif ($text =~ s/^RETURN//) {
		%line = (kind => 'return');
	} elsif ($text =~ s/^([\w.]+) :=//) {
		%line = (kind => 'store', to => $1);
	} elsif ($text =~ s/^([\w.]+) ([SR])=//) {
		%line = (kind => $2, to => $1);
	} elsif ($text =~ s/^(\w+)\(//) {
		my $p = {list => tokens($text)};
		my ($in, $out) = parse_args($p);
		return {kind => 'block', name => $1, in => $in, out => $out};
	} else {
		die "no line: $text";
	}
	$text =~ s/^ IF // if $line{kind} =~ /jump|return/;
	$line{value} = parse_two({list => tokens($text)}, 0) if $text =~ /\S/;
	return \%line;
}

# The POUs of a file: networks with lines, variables with types and initial values.
sub parse {
	my ($text) = @_;
	my (%pou, $pou, $vars);
	for (map { s{\s*//.*}{}r } split /\n/, $text) {
		if (/^(?:PROGRAM|FUNCTION_BLOCK|FUNCTION) (\w+)(?: : (\w+))? FBD/) {
			$pou = $pou{$1} = {name => $1, type => {}, init => {}, network => [], result => $2, input => []};
			$pou->{type}{$1} = $2, $pou->{init}{$1} = $2 eq 'STRING' ? '' : 0 if $2;
		} elsif (/^VAR(_INPUT)?/) {
			$vars = $1 // '';
		} elsif (/^\s+(\w+)\s*: (\w+)(?:\[\d+\])?(?: := (\S+))?;/) {
			my ($name, $type, $init) = ($1, $2, $3);
			$pou->{type}{$name} = $type;
			$pou->{init}{$name} = !defined $init ? ($type eq 'STRING' ? '' : 0) : $type eq 'BOOL' ? ($init eq 'TRUE' ? 1 : 0) :
				$type eq 'STRING' ? $init =~ s/'//gr : $type eq 'TIME' ? 0 + $init =~ s/\D//gr : $type eq "REAL" ? float($init) : 0 + $init
				if $type =~ /^(?:BOOL|INT|DINT|REAL|WORD|TIME|STRING)$/;
			push @{$pou->{input}}, $name if $vars eq '_INPUT';
		} elsif (/^NETWORK( OFF)?(?: (\w+))?/) {
			push @{$pou->{network}}, {off => $1, label => $2 // '', line => []};
		} elsif (/^  (\S.*)/) {
			my $network = $pou->{network}[-1];
			push @{$network->{line}}, parse_line($1) unless $network->{off};
		}
	}
	return \%pou;
}

# ---- instances ----

sub new_instance {
	my ($pous, $name) = @_;
	my $pou = $pous->{$name};
	return {block => $name} unless $pou;
	my %of = (pou => $pou, value => {%{$pou->{init}}}, wire => [map { {} } @{$pou->{network}}],
		  edge => {}, inside => {});
	for my $var (keys %{$pou->{type}}) {
		next if exists $pou->{init}{$var};
		$of{inside}{$var} = new_instance($pous, $pou->{type}{$var});
	}
	return \%of;
}

my %fresh = (TON => {Q => 0, ET => 0}, TOF => {Q => 0, ET => 0}, TP => {Q => 0, ET => 0}, CTU => {Q => 0, CV => 0},
	     SR => {Q1 => 0}, RS => {Q1 => 0}, R_TRIG => {Q => 0}, F_TRIG => {Q => 0});
my %type_of_pin = (Q => 'BOOL', Q1 => 'BOOL', CV => 'INT', ET => 'TIME');

sub output_of {
	my ($inside, $pin) = @_;
	return ($inside->{pou}{type}{$pin}, $inside->{value}{$pin}) if $inside->{pou};
	return ($type_of_pin{$pin}, ($inside->{out} // {})->{$pin} // $fresh{$inside->{block}}{$pin} // 0);
}

# One call of a block of the catalogue; inputs stay from call to call.
sub run_block {
	my ($b, $now) = @_;
	my $in = $b->{in} //= {};
	my $out = $b->{out} //= {%{$fresh{$b->{block}}}};
	my ($on, $pt) = ($in->{IN} // 0, $in->{PT} // 0);
	$pt = 0 if $pt < 0;
	if ($b->{block} eq 'TON') {
		$b->{since} = $now if $on && !$b->{was};
		$out->{ET} = !$on ? 0 : $now - $b->{since} < $pt ? $now - $b->{since} : $pt;
		$out->{Q} = $on && $now - $b->{since} >= $pt ? 1 : 0;
	} elsif ($b->{block} eq 'TOF') { # when its time is over, only IN begins another, whatever PT becomes
		@$out{qw(Q ET)} = (1, 0) if $on;
		$b->{since} = $now if !$on && $b->{was};
		if (!$on && $out->{Q}) {
			my $spent = $now - $b->{since};
			@$out{qw(Q ET)} = $spent < $pt ? (1, $spent) : (0, $pt);
		}
	} elsif ($b->{block} eq 'TP') {
		@$b{qw(waits since)} = (1, $now) if my $begins = $on && !$b->{waits};
		if ($begins || $out->{Q}) {
			my $spent = $now - $b->{since};
			@$out{qw(Q ET)} = $spent < $pt ? (1, $spent) : (0, $pt);
		}
		($b->{waits}, $out->{ET}) = (0, 0) if !$on && !$out->{Q};
	} elsif ($b->{block} eq 'CTU') {
		my $cu = $in->{CU} // 0;
		$out->{CV}++ if $cu && !$b->{was} && !($in->{R} // 0) && $out->{CV} < 32767;
		$out->{CV} = 0 if $in->{R};
		$out->{Q} = $out->{CV} >= ($in->{PV} // 0) ? 1 : 0;
		$b->{was} = $cu;
		return;
	} elsif ($b->{block} eq 'SR') {
		$out->{Q1} = ($in->{S1} || ($out->{Q1} && !$in->{R})) ? 1 : 0;
	} elsif ($b->{block} eq 'RS') {
		$out->{Q1} = (!$in->{R1} && ($in->{S} || $out->{Q1})) ? 1 : 0;
	} elsif ($b->{block} eq 'R_TRIG') {
		my $clk = $in->{CLK} // 0;
		$out->{Q} = $clk && !$b->{was} ? 1 : 0;
		$b->{was} = $clk;
		return;
	}
	$b->{was} = $on;
}

# ---- values ----

# A run of one network: what has been asked for.
sub name_type {
	my ($run, $at, $name) = @_;
	my $of = $run->{of};
	my ($inside, $pin) = split /\./, $name;
	if (defined $pin) {
		my ($type) = output_of($of->{inside}{$inside}, $pin);
		return $type;
	}
	return $of->{pou}{type}{$name} // $run->{wire_type}{$name} // ''; # not known yet
}

my %function_type = (LEN => 'INT', INT_TO_DINT => 'DINT', DINT_TO_INT => 'INT', INT_TO_REAL => 'REAL', R_EDGE => 'BOOL',
		     F_EDGE => 'BOOL', map { $_ => 'BOOL' } qw(GT GE EQ LE LT NE));

sub infer {
	my ($run, $at, $e) = @_;
	return $e->{type} if $e->{kind} eq 'constant';
	return name_type($run, $at, $e->{name}) if $e->{kind} eq 'name';
	return infer($run, $at, $e->{arg}[0]) if $e->{kind} eq 'not';
	return infer($run, $at, $e->{in}[0][1]) if $e->{kind} eq 'call' && $e->{name} eq 'PREVIOUS';
	if ($e->{kind} eq 'two') {
		return 'BOOL' if $e->{op} =~ /^[<>=]/;
		return infer($run, $at, $e->{arg}[0]) || infer($run, $at, $e->{arg}[1]);
	}
	return $function_type{$e->{name}} if $function_type{$e->{name}};
	return $run->{pous}{$e->{name}}{result} if $run->{pous}{$e->{name}};
	my $type = '';
	for my $arg (grep { $_->[0] !~ /^(?:EN|G|K|N|L)$/ } inputs_of($e)) {
		$type ||= infer($run, $at, $arg->[1]);
	}
	return $type;
}

my %pins = (SEL => [qw(G IN0 IN1)], LIMIT => [qw(MN IN MX)], SHL => [qw(IN N)], SHR => [qw(IN N)], ROL => [qw(IN N)],
	    ROR => [qw(IN N)], LEFT => [qw(IN L)], RIGHT => [qw(IN L)], ABS => ['IN'], LEN => ['IN'], MOVE => ['IN'],
	    MUX => ['K', map { "IN$_" } 0 .. 15]);

# The arguments with the names of their pins.
sub inputs_of {
	my ($e) = @_;
	my @names = @{$pins{$e->{name}} // [map { "IN$_" } 1 .. 16]};
	my $n = 0;
	return map { [$_->[0] ne '' ? $_->[0] : $names[$n++], $_->[1]] } @{$e->{in}};
}

# An integer of the type: whether it fits, and its bits.
sub whole {
	my ($type, $value) = @_;
	return (1, $value) unless $low{$type};
	return (1, $value) if $value >= $low{$type} && $value < $low{$type} + $span{$type};
	return (0, ($value - $low{$type}) % $span{$type} + $low{$type});
}

# Two operands, pair by pair: (good, value, has one).
sub arithmetic {
	my ($op, $type, $a, $b) = @_;
	return (1, $op eq '+' ? float($a + $b) : $op eq '-' ? float($a - $b) : float($a * $b), 1) if $type eq 'REAL';
	if ($op eq '/' || $op eq 'MOD') {
		return (0, 0, 0) if $b == 0;
		my $q = POSIX::trunc($a / $b);
		return $op eq '/' ? $b == -1 && $a == $low{$type} ? (0, 0, 0) : (1, $q, 1) : (1, $a - $q * $b, 1);
	}
	use integer;
	my $value = $op eq '+' ? $a + $b : $op eq '-' ? $a - $b : $a * $b;
	no integer;
	return (whole($type, $value), 1);
}

sub compares {
	my ($op, $a, $b, $type) = @_;
	my $c = $type eq 'STRING' ? $a cmp $b : $a <=> $b;
	return ($op eq '<' || $op eq 'LT' ? $c < 0 : $op eq '>' || $op eq 'GT' ? $c > 0 : $op eq '=' || $op eq 'EQ' ? $c == 0 :
		$op eq '<>' || $op eq 'NE' ? $c != 0 : $op eq '<=' || $op eq 'LE' ? $c <= 0 : $c >= 0) ? 1 : 0;
}

# What a name is at line $at: of the last line above that gives it, or from before the network.
sub value_of {
	my ($run, $at, $name) = @_;
	my $of = $run->{of};
	my ($base) = $name =~ /^(\w+)/;
	my (undef, $pin) = split /\./, $name;
	my $giver = last_giver($run, $at, $base);
	for (my $i = $giver; defined $pin && $i >= 0; $i--) { # a call that was left out changes nothing
		return $run->{after}{"$base/$i"}{$pin} // 0 if $run->{after}{"$base/$i"};
	}
	return $run->{start_block}{$base}{$pin} // 0 if defined $pin;
	for (my $i = $giver; $i >= 0; $i--) { # a line that was left out, or gave nothing
		return $run->{gave}[$i]{$base} if exists $run->{gave}[$i]{$base};
	}
	return exists $of->{pou}{type}{$base} ? $run->{start}{$base} : $run->{start_wire}{$base} // die "no value: $base";
}

# The last line above that may give it; all of them have been evaluated then.
sub last_giver {
	my ($run, $at, $base) = @_;
	my @giver = grep { my $i = $_; grep { $_ eq $base } @{$run->{gives}[$i]} } 0 .. $at - 1;
	want($run, $_) for reverse @giver;
	return @giver ? $giver[-1] : -1;
}

# The value of an expression. $chain: {ok}: no operation of the line has failed so far; {last}: whether the last
# one gave a result all the same.
sub compute {
	my ($run, $at, $e, $type, $chain) = @_;
	$chain->{last} = 0;
	if ($e->{kind} eq 'constant') {
		return $type eq 'REAL' && !$e->{type} ? float($e->{value}) : $e->{value};
	}
	return value_of($run, $at, $e->{name}) if $e->{kind} eq 'name';
	if ($e->{kind} eq 'not') {
		my $v = compute($run, $at, $e->{arg}[0], $type, $chain);
		if (infer($run, $at, $e) eq 'WORD') {
			$chain->{last} = $chain->{ok};
			return ~$v & 0xffff;
		}
		$chain->{last} = 0;
		return $v ? 0 : 1;
	}
	return compute_two($run, $at, $e, $chain) if $e->{kind} eq 'two';
	return compute_call($run, $at, $e, $chain);
}

sub compute_two {
	my ($run, $at, $e, $chain) = @_;
	my $own = infer($run, $at, $e->{arg}[0]) || infer($run, $at, $e->{arg}[1]);
	my $a = compute($run, $at, $e->{arg}[0], $own, $chain);
	my $b = compute($run, $at, $e->{arg}[1], $own, $chain);
	$chain->{last} = 0;
	return compares($e->{op}, $a, $b, $own) if $e->{op} =~ /^[<>=]/;
	if ($e->{op} =~ /^(?:AND|OR|XOR)$/) {
		$chain->{last} = $chain->{ok} if $own eq 'WORD';
		return $e->{op} eq 'AND' ? $a & $b : $e->{op} eq 'OR' ? $a | $b : $a ^ $b;
	}
	return 0 unless $chain->{ok};
	my ($good, $value, $has) = arithmetic($e->{op}, $own, $a, $b);
	$chain->{ok} = $good;
	$chain->{last} = $has;
	return $value;
}

sub edge {
	my ($run, $at, $e, $chain) = @_;
	my $v = compute($run, $at, $e->{in}[0][1], 'BOOL', $chain) ? 1 : 0;
	my $memory = $run->{of}{edge};
	my $was = $memory->{$e} // 0;
	my $out = $e->{name} eq 'R_EDGE' ? $v && !$was : !$v && $was;
	$memory->{$e} = $v if $chain->{ok};
	$chain->{last} = 0;
	return $out && $chain->{ok} ? 1 : 0;
}

sub compute_call {
	my ($run, $at, $e, $chain) = @_;
	my $name = $e->{name};
	if ($name eq 'PREVIOUS') {
		$chain->{last} = 0;
		return $run->{start_wire}{$e->{in}[0][1]{name}} // die "no wire: $e->{in}[0][1]{name}";
	}
	return edge($run, $at, $e, $chain) if $name =~ /^[RF]_EDGE$/;
	my $pou = $run->{pous}{$name};
	my $own = $pou ? '' : $function_type{$name} ? '' : infer($run, $at, $e);
	my @in = inputs_of($e);
	for my $arg (@in) {
		if ($arg->[0] eq 'EN') {
			my $en = compute($run, $at, $arg->[1], 'BOOL', $chain);
			$chain->{ok} &&= $en;
		}
	}
	my %in;
	my @values;
	my $shared = $own;
	if (!$pou && $function_type{$name}) {
		$shared ||= infer($run, $at, $_->[1]) for grep { $_->[0] ne 'EN' } @in;
	}
	my $n = 0;
	for my $arg (grep { $_->[0] ne 'EN' } @in) {
		my $pin = $pou ? ($arg->[0] =~ /^IN\d+$/ ? $pou->{input}[$n] : $arg->[0]) : $arg->[0];
		my $wanted = $pou ? $pou->{type}{$pin} : $pin eq 'G' ? 'BOOL' : $pin =~ /^[KNL]$/ ? 'INT' : $shared;
		my $v = compute($run, $at, $arg->[1], $wanted, $chain);
		$in{$pin} = $v;
		push @values, $v;
		$n++;
	}
	my ($good, $value, $has) = (0, 0, 0);
	if ($chain->{ok}) {
		($good, $value, $has) = $pou ? run_function($run, $pou, \%in) : known($name, $shared, \%in, \@values);
	}
	$chain->{ok} &&= $good;
	for my $out (@{$e->{out}}) { # ENO
		$run->{gave}[$at]{$out->[1]} = ($chain->{ok} xor $out->[2]) ? 1 : 0;
	}
	$chain->{last} = $has;
	return $value;
}

sub known {
	my ($name, $type, $in, $values) = @_;
	my @v = @$values;
	if ($name =~ /^(?:ADD|SUB|MUL|DIV|MOD)$/) {
		my %op = (ADD => '+', SUB => '-', MUL => '*', DIV => '/', MOD => 'MOD');
		my ($all, $sum) = (1, shift @v);
		for (@v) {
			my ($good, $value, $has) = arithmetic($op{$name}, $type, $sum, $_);
			return (0, 0, 0) unless $has;
			$all &&= $good;
			$sum = $value;
		}
		return ($all, $sum, 1);
	}
	if ($name =~ /^(?:GT|GE|EQ|LE|LT|NE)$/) {
		my $all = 1;
		$all &&= compares($name, $v[$_ - 1], $v[$_], $type) for 1 .. $#v;
		return (1, $all, 1);
	}
	if ($name =~ /^(?:AND|OR|XOR)$/) {
		my $sum = shift @v;
		$sum = $name eq 'AND' ? $sum & $_ : $name eq 'OR' ? $sum | $_ : $sum ^ $_ for @v;
		return (1, $sum, 1);
	}
	if ($name eq 'MAX' || $name eq 'MIN') {
		my $best = shift @v;
		for (@v) {
			$best = $_ if compares($name eq 'MAX' ? '>' : '<', $_, $best, $type);
		}
		return (1, $best, 1);
	}
	if ($name eq 'LIMIT') {
		my $least = $in->{IN} > $in->{MN} ? $in->{IN} : $in->{MN};
		return (1, $least < $in->{MX} ? $least : $in->{MX}, 1);
	}
	return (1, $in->{G} ? $in->{IN1} : $in->{IN0}, 1) if $name eq 'SEL';
	return exists $in->{"IN$in->{K}"} ? (1, $in->{"IN$in->{K}"}, 1) : (0, 0, 0) if $name eq 'MUX';
	return (whole($type, abs $v[0]), 1) if $name eq 'ABS';
	return (1, $v[0], 1) if $name =~ /^(?:MOVE|INT_TO_DINT)$/;
	return (1, float($v[0]), 1) if $name eq 'INT_TO_REAL';
	return (whole('INT', $v[0]), 1) if $name eq 'DINT_TO_INT';
	return (1, length $v[0], 1) if $name eq 'LEN';
	return (1, join('', @v), 1) if $name eq 'CONCAT';
	return (1, substr($v[0], 0, $v[1]), 1) if $name eq 'LEFT';
	return (1, $v[1] < length $v[0] ? substr($v[0], length($v[0]) - $v[1]) : $v[0], 1) if $name eq 'RIGHT';
	my ($bits, $by) = ($v[0], $v[1]);
	return (1, $by > 15 ? 0 : $bits << $by & 0xffff, 1) if $name eq 'SHL';
	return (1, $by > 15 ? 0 : $bits >> $by, 1) if $name eq 'SHR';
	$by = $name eq 'ROL' ? $by % 16 : (16 - $by % 16) % 16;
	return (1, ($bits << $by | $bits >> 16 - $by) & 0xffff, 1) if $name =~ /^RO[LR]$/;
	die "no function $name";
}

sub run_function {
	my ($run, $pou, $in) = @_;
	my $of = new_instance($run->{pous}, $pou->{name});
	$of->{value}{$_} = $in->{$_} for keys %$in;
	run_pou($run->{pous}, $of, $run->{now});
	return (1, $of->{value}{$pou->{name}}, 1);
}

# ---- lines ----

# Does the line run? Not behind a JMP or RETURN that was taken.
sub runs {
	my ($run, $at) = @_;
	for my $i (grep { $_ < $at } @{$run->{leaves}}) {
		want($run, $i);
		return 0 if $run->{taken}[$i];
	}
	return 1;
}

sub cut { my ($type, $value) = @_; $type eq 'STRING' ? substr($value, 0, 20) : $value }

# Evaluates a line, once.
sub want {
	my ($run, $at) = @_;
	my $line = $run->{line}[$at];
	return if $run->{done}[$at]++;
	return unless runs($run, $at);
	my $of = $run->{of};
	my $chain = {ok => 1, last => 0};
	if ($line->{kind} eq 'block') {
		call_block($run, $at, $line);
		return;
	}
	my $type = $line->{kind} eq 'store' ? name_type($run, $at, $line->{to}) : 'BOOL';
	my $value = $line->{value} ? compute($run, $at, $line->{value}, $type, $chain) : 1;
	if ($line->{kind} eq 'store') {
		$run->{gave}[$at]{$line->{to}} = exists $of->{pou}{type}{$line->{to}} ? cut($type, $value) : $value
			if $chain->{ok} || $chain->{last};
	} elsif ($chain->{ok} && $value) {
		if ($line->{kind} =~ /^[SR]$/) {
			$run->{gave}[$at]{$line->{to}} = $line->{kind} eq 'S' ? 1 : 0;
		} else {
			$run->{taken}[$at] = 1;
		}
	}
}

sub snapshot {
	my ($inside) = @_;
	return $inside->{pou} ? {%{$inside->{value}}} : {%{$inside->{out} // $fresh{$inside->{block}}}};
}

sub call_block {
	my ($run, $at, $line) = @_;
	my $inside = $run->{of}{inside}{$line->{name}};
	my %in;
	last_giver($run, $at, $line->{name}); # earlier calls come first
	my $on = 1;
	for my $arg (@{$line->{in}}) {
		my $type = $inside->{pou} ? $inside->{pou}{type}{$arg->[0]} : $arg->[0] =~ /^(?:PT)$/ ? 'TIME' :
			$arg->[0] eq 'PV' ? 'INT' : 'BOOL';
		my $chain = {ok => 1};
		last unless $on;
		my $value = compute($run, $at, $arg->[1], $type || 'BOOL', $chain);
		if ($arg->[0] eq 'EN') {
			$on = $chain->{ok} && $value;
		} else {
			$on = $chain->{ok};
			$in{$arg->[0]} = $value;
		}
	}
	if ($on) {
		if ($inside->{pou}) {
			$inside->{value}{$_} = $in{$_} for keys %in;
			run_pou($run->{pous}, $inside, $run->{now});
		} else {
			$inside->{in}{$_} = $in{$_} for keys %in;
			run_block($inside, $run->{now});
		}
		for my $out (@{$line->{out}}) {
			my (undef, $value) = output_of($inside, $out->[0]);
			$run->{gave}[$at]{$out->[1]} = $out->[2] ? !$value || 0 : $value;
		}
	}
	$run->{after}{"$line->{name}/$at"} = snapshot($inside);
}

sub outs_in {
	my ($e) = @_;
	return () unless ref $e eq 'HASH';
	return ((map { $_->[1] } @{$e->{out} // []}), (map { outs_in($_) } @{$e->{arg} // []}),
		(map { outs_in($_->[1]) } @{$e->{in} // []}));
}

# Returns: undef: goes on; -1: RETURN; else the label.
sub run_network {
	my ($pous, $of, $number, $now) = @_;
	my $network = $of->{pou}{network}[$number];
	my $wires = $of->{wire}[$number];
	my @line = @{$network->{line}};
	my $run = {pous => $pous, of => $of, line => \@line, now => $now, done => [], taken => [], gave => [map { {} } @line],
		   start => {%{$of->{value}}}, start_wire => {%$wires}, after => {},
		   start_block => {map { $_ => snapshot($of->{inside}{$_}) } keys %{$of->{inside}}}};
	$run->{wire_type} = $network->{wire_type} //= {};
	for my $line (@line) {
		my @gives = outs_in($line);
		push @gives, map { outs_in($_) } $line->{value} if $line->{value};
		push @gives, $line->{to} if defined $line->{to};
		push @gives, $line->{name} if $line->{kind} eq 'block';
		push @{$run->{gives}}, \@gives;
	}
	$run->{leaves} = [grep { $line[$_]{kind} =~ /jump|return/ } 0 .. $#line];
	find_types($run);
	for my $name (keys %{$run->{wire_type}}) {
		$run->{start_wire}{$name} //= $run->{wire_type}{$name} eq 'STRING' ? '' : 0;
	}
	want($run, $_) for reverse 0 .. $#line;
	my $end;
	for my $i (@{$run->{leaves}}) {
		$end //= $line[$i]{kind} eq 'return' ? -1 : $line[$i]{label} if $run->{taken}[$i];
	}
	for my $i (0 .. $#line) {
		for my $name (keys %{$run->{gave}[$i]}) {
			if (exists $of->{pou}{type}{$name}) {
				$of->{value}{$name} = $run->{gave}[$i]{$name};
			} else {
				$wires->{$name} = $run->{gave}[$i]{$name};
			}
		}
	}
	return $end;
}

# Wires have the types of their values; PREVIOUS may name one further down.
sub find_types {
	my ($run) = @_;
	return if %{$run->{wire_type}};
	my $of = $run->{of};
	for my $round (1 .. 3) {
		for my $i (0 .. $#{$run->{line}}) {
			my $line = $run->{line}[$i];
			for my $out (outs_in({in => $line->{in} // [], arg => [$line->{value} // ()]})) {
				$run->{wire_type}{$out} = 'BOOL' unless exists $of->{pou}{type}{$out};
			}
			for my $out ($line->{kind} eq 'block' ? @{$line->{out}} : ()) {
				my ($type) = output_of($of->{inside}{$line->{name}}, $out->[0]);
				$run->{wire_type}{$out->[1]} = $type unless exists $of->{pou}{type}{$out->[1]};
			}
			next if $line->{kind} ne 'store' || exists $of->{pou}{type}{$line->{to}};
			my $type = infer($run, $i, $line->{value});
			$run->{wire_type}{$line->{to}} = $type if $type;
		}
	}
}

sub run_pou {
	my ($pous, $of, $now) = @_;
	my $networks = $of->{pou}{network};
	for (my $n = 0; $n < @$networks; $n++) {
		next if $networks->[$n]{off};
		my $end = run_network($pous, $of, $n, $now);
		next unless defined $end;
		return if $end eq '-1';
		my ($to) = grep { $networks->[$_]{label} eq $end } 0 .. $#$networks;
		$n = $to - 1;
	}
}

1;
