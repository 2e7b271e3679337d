(** Certificates of pieces for Coq's kernel: what is read is checked by a function that is itself proven, for real functions
    with their real derivatives. [theory.py], in the folder above, writes a certificate as a file that needs this one. *)

From Coq Require Export List ZArith.
From Coq Require Import QArith Qreals Reals Arith Lia Lra Ring_polynom Ring_theory.
Export ListNotations.
Open Scope R_scope.

(** Polynomials in symbols, in the normal form of Coq's tactic [ring], with rational coefficients in lowest terms. *)

Definition plus a b := Qred (a + b).
Definition times a b := Qred (a * b).
Definition minus a b := Qred (a - b).

Lemma reduced a : Q2R (Qred a) = Q2R a.
Proof. apply Qeq_eqR, Qred_correct. Qed.

Lemma rationals : ring_morph 0 1 Rplus Rmult Rminus Ropp eq 0%Q 1%Q plus times minus Qopp Qeq_bool Q2R.
Proof.
  constructor; intros; unfold plus, times, minus; rewrite ?reduced.
  - apply RMicromega.Q2R_0.
  - apply RMicromega.Q2R_1.
  - apply Q2R_plus.
  - apply Q2R_minus.
  - apply Q2R_mult.
  - apply Q2R_opp.
  - apply Qeq_eqR, Qeq_bool_eq. assumption.
Qed.

Notation pol := (Pol Q).
Definition none : pol := Pc 0%Q.
Definition one : pol := Pc 1%Q.
Definition padd : pol -> pol -> pol := Padd 0%Q plus Qeq_bool.
Definition pmul : pol -> pol -> pol := Pmul 0%Q 1%Q plus times Qeq_bool.

Fixpoint ppow (p : pol) (k : nat) := match k with O => one | S k => pmul p (ppow p k) end.

(** A polynomial from its terms: a coefficient, and symbols, counted from 1, with their powers. *)
Definition terms := list (Q * list (positive * nat)).
Definition monomial (powers : list (positive * nat)) : pol :=
  fold_right (fun '(x, k) => pmul (ppow (mk_X 0%Q 1%Q x) k)) one powers.
Definition polynomial (all : terms) : pol :=
  fold_right (fun '(c, powers) => padd (pmul (Pc c) (monomial powers))) none all.

(** As theories write them. *)
Definition x (symbol : positive) (power : nat) := (symbol, power).
Definition t (above : Z) (below : positive) (powers : list (positive * nat)) := ((above # below)%Q, powers).
Definition p := polynomial.
Arguments x (_)%positive (_)%nat.
Arguments t (_)%Z (_)%positive _.

(** Polynomials in the time: the coefficient of its power 0, 1, ... *)
Notation course := (list pol).

Fixpoint add (p q : course) : course :=
  match p, q with
  | [], _ => q
  | _, [] => p
  | c :: p, d :: q => padd c d :: add p q
  end.

Definition scaled (c : pol) : course -> course := map (pmul c).
Fixpoint mul (p q : course) : course := match p with [] => [] | c :: p => add (scaled c q) (none :: mul p q) end.
Fixpoint slope (p : course) : course := match p with [] => [] | _ :: p => add p (none :: slope p) end.
Fixpoint put (p q : course) : course := match p with [] => [] | c :: p => add [c] (mul q (put p q)) end.

(** A ratio is a course over powers of the factors that occur in denominators; an expression is the sum of all R exp(X). *)
Definition ratio := (list nat * course)%type.
Definition expression := list (ratio * ratio).
Definition r (below : list nat) (above : course) : ratio := (below, above).
Arguments r (_)%nat _.

Fixpoint both (d e : list nat) : list nat :=
  match d, e with
  | [], _ => e
  | _, [] => d
  | j :: d, k :: e => (j + k)%nat :: both d e
  end.

Fixpoint most (d e : list nat) : list nat :=
  match d, e with
  | [], _ => e
  | _, [] => d
  | j :: d, k :: e => Nat.max j k :: most d e
  end.

Fixpoint lacking (whole d : list nat) : list nat :=
  match whole, d with
  | [], _ => []
  | _, [] => whole
  | j :: whole, k :: d => (j - k)%nat :: lacking whole d
  end.

Definition product (r q : ratio) : ratio := (both (fst r) (fst q), mul (snd r) (snd q)).
Definition opposite (r : ratio) : ratio := (fst r, scaled (Pc (-1)%Q) (snd r)).
Definition changed (f : course -> course) (e : expression) : expression :=
  map (fun '(x, r) => ((fst x, f (snd x)), (fst r, f (snd r)))) e.
Definition multiple (c : ratio) (e : expression) : expression := map (fun '(x, r) => (x, product c r)) e.
Definition negative (e : expression) : expression := map (fun '(x, r) => (x, opposite r)) e.
Definition derivative (e : expression) : expression :=
  flat_map (fun '(x, r) => [(x, (fst r, slope (snd r))); (x, product (fst x, slope (snd x)) r)]) e.

(** What is said of waves: on period n, the sum of all coefficient · operator(wave) at lag, and of forcing later by lag. *)
Inductive operator := Value | Slope | Sum.
Record form := { waves : list (operator * nat * nat * ratio); forcing : list (nat * expression) }.

Record certificate := {
  factors : list pol;
  period : pol;
  equations : list form;
  continuity : list (form * expression);
  through : nat;
  pieces : list (list expression) }.

Section Checked.
Variable c : certificate.

Definition piece (wave n : nat) : expression := nth n (nth wave (pieces c) []) [].

Fixpoint denominator (fs : list pol) (d : list nat) : pol :=
  match fs, d with
  | f :: fs, k :: d => pmul (ppow f k) (denominator fs d)
  | _, _ => one
  end.

(** Whether a sum of ratios is zero: over one denominator. *)
Definition cancels (rs : list ratio) : bool :=
  let whole := fold_right most [] (map fst rs) in
  let over r := scaled (denominator (factors c) (lacking whole (fst r))) (snd r) in
  forallb (fun r => if list_eq_dec Nat.eq_dec (both (fst r) (lacking whole (fst r))) whole then true else false) rs
  && forallb (fun p => Peq Qeq_bool p none) (fold_right add [] (map over rs)).

(** Whether an expression is zero: the ratios before each exponential cancel. *)
Fixpoint vanishes (fuel : nat) (e : expression) : bool :=
  match fuel, e with
  | _, [] => true
  | O, _ => false
  | S fuel, (x, r) :: e =>
      let (same, others) := partition (fun t => cancels [x; opposite (fst t)]) e in
      cancels (r :: map snd same) && vanishes fuel others
  end.

Definition is_zero (e : expression) := vanishes (length e) e.

Definition later (m : nat) : course := [pmul (Pc (inject_Z (Z.of_nat m))) (period c); one].

Definition operated (k : operator) (wave lag n : nat) : expression :=
  match k with
  | Sum => flat_map (piece wave) (seq 0 (n - lag))
  | Value => if lag <=? n then piece wave (n - lag) else []
  | Slope => if lag <=? n then derivative (piece wave (n - lag)) else []
  end.

Definition on_period (f : form) (n : nat) : expression :=
  flat_map (fun '(k, wave, lag, a) => multiple a (operated k wave lag n)) (waves f)
  ++ flat_map (fun '(lag, e) => if lag <=? n then changed (fun p => put p (later (n - lag))) e else []) (forcing f).

Definition at_start := changed (fun p => put p []).
Definition at_end := changed (fun p => put p [period c]).

Definition check : bool :=
  forallb (fun n =>
    forallb (fun f => is_zero (on_period f n)) (equations c)
    && forallb (fun '(f, start) =>
         is_zero (at_start (on_period f n) ++ negative (match n with O => at_start start | S m => at_end (on_period f m) end)))
       (continuity c))
  (seq 0 (S (through c))).

(** * What it all means, for real values of the symbols *)

Variable symbols : list R.

Definition at_symbols (p : pol) : R := Pphi 0 Rplus Rmult Q2R symbols p.
Fixpoint along (p : course) (s : R) : R := match p with [] => 0 | a :: p => at_symbols a + s * along p s end.
Definition quotient (r : ratio) (s : R) := along (snd r) s / at_symbols (denominator (factors c) (fst r)).
Fixpoint value (e : expression) (s : R) : R :=
  match e with [] => 0 | (x, r) :: e => quotient r s * exp (quotient x s) + value e s end.

(** A wave on a period, as a function of local time; its derivative; the sum of all earlier periods. *)
Definition wave (w n : nat) (s : R) : R := value (piece w n) s.
Definition steepness (w n : nat) (s : R) : R := value (derivative (piece w n)) s.
Fixpoint earlier (w n : nat) (s : R) : R := match n with O => 0 | S m => earlier w m s + wave w m s end.

Definition applied (k : operator) (w lag n : nat) (s : R) : R :=
  match k with
  | Sum => earlier w (n - lag) s
  | Value => if lag <=? n then wave w (n - lag) s else 0
  | Slope => if lag <=? n then steepness w (n - lag) s else 0
  end.

Definition total {A} (f : A -> R) (all : list A) : R := fold_right (fun a sum => f a + sum) 0 all.

Definition said (f : form) (n : nat) (s : R) : R :=
  total (fun '(k, w, lag, a) => quotient a s * applied k w lag n s) (waves f)
  + total (fun '(lag, e) => if lag <=? n then value e (s + INR (n - lag) * at_symbols (period c)) else 0) (forcing f).

(** The claim: steepness is the derivative, every equation holds at all local times, and what is continuous is. *)
Definition holds : Prop :=
  (forall w n s, derivable_pt_lim (wave w n) s (steepness w n s))
  /\ (forall f, In f (equations c) -> forall n, (n <= through c)%nat -> forall s, said f n s = 0)
  /\ (forall f start, In (f, start) (continuity c) ->
        said f 0 0 = value start 0
        /\ forall n, (n < through c)%nat -> said f (S n) 0 = said f n (at_symbols (period c))).

(** It is made wherever nothing is divided by zero. *)
Definition divides_by_nonzero : Prop := Forall (fun f => at_symbols f <> 0) (factors c).
Hypothesis nonzero : divides_by_nonzero.

(** * Proofs *)

Definition Add p q := Padd_ok (Eqsth R) (Eq_ext Rplus Rmult Ropp) (Rth_ARth (Eqsth R) (Eq_ext Rplus Rmult Ropp) RTheory) rationals q p symbols.
Definition Mul p q := Pmul_ok (Eqsth R) (Eq_ext Rplus Rmult Ropp) (Rth_ARth (Eqsth R) (Eq_ext Rplus Rmult Ropp) RTheory) rationals p q symbols.

Lemma at_add p q : at_symbols (padd p q) = at_symbols p + at_symbols q.
Proof. apply Add. Qed.

Lemma at_mul p q : at_symbols (pmul p q) = at_symbols p * at_symbols q.
Proof. apply Mul. Qed.

Lemma at_number a : at_symbols (Pc a) = Q2R a.
Proof. reflexivity. Qed.

Lemma at_none : at_symbols none = 0.
Proof. apply RMicromega.Q2R_0. Qed.

Lemma at_one : at_symbols one = 1.
Proof. apply RMicromega.Q2R_1. Qed.

Lemma at_zero p : Peq Qeq_bool p none = true -> at_symbols p = 0.
Proof.
  intro H. rewrite <- at_none.
  apply (Peq_ok (Eqsth R) (Eq_ext Rplus Rmult Ropp) rationals _ _ H symbols).
Qed.

Lemma at_power p k : at_symbols (ppow p k) = at_symbols p ^ k.
Proof. induction k; simpl; [apply at_one | now rewrite at_mul, IHk]. Qed.

(** Terms mean what they look like. *)
Lemma at_polynomial all :
  at_symbols (polynomial all)
  = total (fun '(a, powers) => Q2R a * fold_right (fun '(x, k) rest => BinList.nth 0 x symbols ^ k * rest) 1 powers) all.
Proof.
  induction all as [|[a powers] all IH]; [apply at_none|].
  change (polynomial ((a, powers) :: all)) with (padd (pmul (Pc a) (monomial powers)) (polynomial all)).
  rewrite at_add, at_mul, at_number, IH. simpl. do 2 f_equal.
  induction powers as [|[x k] powers more]; [apply at_one|].
  change (monomial ((x, k) :: powers)) with (pmul (ppow (mk_X 0%Q 1%Q x) k) (monomial powers)).
  rewrite at_mul, at_power, more. simpl. do 2 f_equal. symmetry.
  apply (mkX_ok (Eqsth R) (Eq_ext Rplus Rmult Ropp) (Rth_ARth (Eqsth R) (Eq_ext Rplus Rmult Ropp) RTheory) rationals).
Qed.

Lemma along_add p q s : along (add p q) s = along p s + along q s.
Proof.
  revert q. induction p as [|a p IH]; intros [|b q]; simpl; try lra.
  rewrite at_add, IH. ring.
Qed.

Lemma along_scaled a p s : along (scaled a p) s = at_symbols a * along p s.
Proof. induction p; simpl; rewrite ?at_mul, ?IHp; ring. Qed.

Lemma along_mul p q s : along (mul p q) s = along p s * along q s.
Proof.
  induction p; simpl; [ring|].
  rewrite along_add, along_scaled; simpl. rewrite at_none, IHp. ring.
Qed.

Lemma along_put p q s : along (put p q) s = along p (along q s).
Proof.
  induction p; [reflexivity|]. cbn [put along].
  rewrite along_add, along_mul, IHp; simpl. ring.
Qed.

Lemma along_slope p s : derivable_pt_lim (along p) s (along (slope p) s).
Proof.
  induction p as [|a p IH]; simpl.
  - apply derivable_pt_lim_const.
  - rewrite along_add; simpl. rewrite at_none.
    replace (along p s + (0 + s * along (slope p) s)) with (0 + (1 * along p s + s * along (slope p) s)) by ring.
    apply (derivable_pt_lim_plus (fct_cte (at_symbols a)) (id * along p)%F); [apply derivable_pt_lim_const|].
    apply (derivable_pt_lim_mult id (along p)); [apply derivable_pt_lim_id | exact IH].
Qed.

Definition over (d : list nat) := at_symbols (denominator (factors c) d).

Lemma over_nonzero d : over d <> 0.
Proof.
  unfold over. revert d. induction nonzero as [|f fs H others IH]; intros [|k d]; simpl; rewrite ?at_one; try lra.
  rewrite at_mul, at_power. apply Rmult_integral_contrapositive_currified; [now apply pow_nonzero | now apply IH].
Qed.

Lemma over_both d e : over (both d e) = over d * over e.
Proof.
  unfold over. clear nonzero. revert d e. induction (factors c) as [|f fs IH]; intros [|j d] [|k e]; simpl; rewrite ?at_one, ?Rmult_1_l, ?Rmult_1_r; try easy.
  rewrite !at_mul, !at_power, IH, pow_add. ring.
Qed.

Lemma quotient_product r q s : quotient (product r q) s = quotient r s * quotient q s.
Proof.
  unfold quotient, product; simpl. fold (over (both (fst r) (fst q))) (over (fst r)) (over (fst q)).
  rewrite along_mul, over_both. field. split; apply over_nonzero.
Qed.

Lemma minus_one : Q2R (-1)%Q = -1.
Proof. unfold Q2R; simpl. field. Qed.

Lemma quotient_opposite r s : quotient (opposite r) s = - quotient r s.
Proof. unfold quotient, opposite; simpl. rewrite along_scaled, at_number, minus_one. unfold Rdiv. ring. Qed.

Lemma quotient_put r q s : quotient (fst r, put (snd r) q) s = quotient r (along q s).
Proof. unfold quotient; simpl. now rewrite along_put. Qed.

Lemma quotient_slope r s : derivable_pt_lim (quotient r) s (quotient (fst r, slope (snd r)) s).
Proof.
  unfold quotient; simpl. set (b := at_symbols _). unfold Rdiv.
  replace (along (slope (snd r)) s * / b) with (along (slope (snd r)) s * fct_cte (/ b) s + along (snd r) s * 0)
    by (unfold fct_cte; ring).
  apply (derivable_pt_lim_mult (along (snd r)) (fct_cte (/ b))); [apply along_slope | apply derivable_pt_lim_const].
Qed.

Lemma value_app d e s : value (d ++ e) s = value d s + value e s.
Proof. induction d as [|[x r] d IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma value_flat {A} (f : A -> expression) all s : value (flat_map f all) s = total (fun a => value (f a) s) all.
Proof. induction all; simpl; [reflexivity|]. now rewrite value_app, IHall. Qed.

Lemma value_multiple a e s : value (multiple a e) s = quotient a s * value e s.
Proof. induction e as [|[x r] e IH]; simpl; [ring|]. rewrite quotient_product, IH. ring. Qed.

Lemma value_negative e s : value (negative e) s = - value e s.
Proof. induction e as [|[x r] e IH]; simpl; [ring|]. rewrite quotient_opposite, IH. ring. Qed.

Lemma value_put e q s : value (changed (fun p => put p q) e) s = value e (along q s).
Proof. induction e as [|[x r] e IH]; simpl; [reflexivity|]. now rewrite !quotient_put, IH. Qed.

Lemma value_derivative e s : derivable_pt_lim (value e) s (value (derivative e) s).
Proof.
  induction e as [|[x r] e IH]; [apply derivable_pt_lim_const|].
  change (derivative ((x, r) :: e)) with ([(x, (fst r, slope (snd r))); (x, product (fst x, slope (snd x)) r)] ++ derivative e).
  rewrite value_app. apply (derivable_pt_lim_plus (quotient r * comp exp (quotient x))%F (value e)); [|exact IH].
  simpl. rewrite quotient_product, Rplus_0_r.
  replace (quotient (fst x, slope (snd x)) s * quotient r s * exp (quotient x s))
    with (quotient r s * (exp (quotient x s) * quotient (fst x, slope (snd x)) s)) by ring.
  apply (derivable_pt_lim_mult (quotient r) (comp exp (quotient x))); [apply quotient_slope|].
  apply derivable_pt_lim_comp; [apply quotient_slope | apply derivable_pt_lim_exp].
Qed.

Lemma along_zero p s : forallb (fun a => Peq Qeq_bool a none) p = true -> along p s = 0.
Proof.
  induction p as [|a p IH]; simpl; [reflexivity|].
  intros [H I]%andb_prop. rewrite (at_zero _ H), (IH I). ring.
Qed.

Lemma cancels_sum rs s : cancels rs = true -> total (fun r => quotient r s) rs = 0.
Proof.
  unfold cancels. set (whole := fold_right most [] (map fst rs)). intros [fits zero]%andb_prop.
  apply (along_zero _ s) in zero. apply (Rmult_eq_reg_l (over whole)); [|apply over_nonzero].
  rewrite Rmult_0_r, <- zero. clear zero. clearbody whole.
  induction rs as [|r rs IH]; simpl; [ring|].
  cbn [forallb] in fits. apply andb_prop in fits. destruct fits as [fit fits].
  rewrite along_add, along_scaled, Rmult_plus_distr_l. rewrite <- (IH fits) at 1. f_equal.
  destruct (list_eq_dec Nat.eq_dec (both (fst r) (lacking whole (fst r))) whole) as [same|]; [|discriminate].
  rewrite <- same at 1. rewrite over_both. fold (over (lacking whole (fst r))).
  unfold quotient. fold (over (fst r)). field. apply over_nonzero.
Qed.

Lemma value_partition f e s :
  value e s = value (fst (partition f e)) s + value (snd (partition f e)) s.
Proof.
  induction e as [|[x r] e IH]; simpl; [ring|].
  destruct (partition f e) as [yes no]; destruct (f (x, r)); simpl in *; rewrite IH; ring.
Qed.

Lemma partition_true {A} f (all : list A) a : In a (fst (partition f all)) -> f a = true.
Proof.
  induction all as [|b all IH]; simpl; [easy|].
  destruct (partition f all); destruct (f b) eqn:E; simpl in *; [intros [<-|]; auto | auto].
Qed.

Lemma vanishes_zero fuel e s : vanishes fuel e = true -> value e s = 0.
Proof.
  revert e. induction fuel as [|fuel IH]; intros [|[x r] e]; try easy.
  cbn [vanishes]. set (f := fun t => cancels [x; opposite (fst t)]).
  pose proof (value_partition f e s) as split. pose proof (partition_true f e) as alike.
  destruct (partition f e) as [same others].
  intros [zero rest]%andb_prop. apply IH in rest. apply (cancels_sum _ s) in zero. simpl in *.
  rewrite split, rest, Rplus_0_r.
  enough (value same s = total (fun r => quotient r s) (map snd same) * exp (quotient x s)) as ->
    by (rewrite <- Rmult_plus_distr_r, zero; ring).
  clear - alike nonzero. induction same as [|[y q] same IH]; simpl; [ring|].
  rewrite IH by (intros; apply alike; now right).
  specialize (alike (y, q) (or_introl eq_refl)). apply (cancels_sum _ s) in alike. simpl in alike.
  rewrite quotient_opposite in alike. replace (quotient y s) with (quotient x s) by lra. ring.
Qed.

Lemma is_zero_value e s : is_zero e = true -> value e s = 0.
Proof. apply vanishes_zero. Qed.

Lemma value_earlier w n s : value (flat_map (piece w) (seq 0 n)) s = earlier w n s.
Proof.
  induction n; [reflexivity|].
  rewrite seq_S, flat_map_app, value_app, IHn. simpl. now rewrite app_nil_r.
Qed.

Lemma number_of m : Q2R (inject_Z (Z.of_nat m)) = INR m.
Proof. unfold Q2R; simpl. rewrite <- INR_IZR_INZ. field. Qed.

Lemma value_on_period f n s : value (on_period f n) s = said f n s.
Proof.
  unfold on_period, said. rewrite value_app, !value_flat. f_equal.
  - induction (waves f) as [|[[[k w] lag] a] all IH]; simpl; [reflexivity|].
    rewrite IH, value_multiple. do 2 f_equal.
    destruct k; simpl; try (destruct (lag <=? n); reflexivity). apply value_earlier.
  - induction (forcing f) as [|[lag e] all IH]; simpl; [reflexivity|].
    rewrite IH. f_equal. destruct (lag <=? n); [|reflexivity].
    rewrite value_put. f_equal. simpl. rewrite at_mul, at_number, number_of, at_one. ring.
Qed.

Theorem checked : check = true -> holds.
Proof.
  unfold check. intro all. rewrite forallb_forall in all.
  assert (forall n, (n <= through c)%nat -> _) as on by (intros n H; apply (all n), in_seq; lia).
  split; [|split].
  - intros. apply value_derivative.
  - intros f H n late s. destruct (andb_prop _ _ (on n late)) as [equal _].
    rewrite <- value_on_period. apply is_zero_value. rewrite forallb_forall in equal. now apply equal.
  - intros f start H. split.
    + destruct (andb_prop _ _ (on 0%nat (Nat.le_0_l _))) as [_ same]. rewrite forallb_forall in same.
      specialize (same _ H). apply (is_zero_value _ 0) in same.
      rewrite value_app, value_negative in same. unfold at_start in same. rewrite !value_put in same.
      rewrite <- value_on_period. simpl in same. lra.
    + intros n late. destruct (andb_prop _ _ (on (S n) late)) as [_ same]. rewrite forallb_forall in same.
      specialize (same _ H). apply (is_zero_value _ 0) in same.
      rewrite value_app, value_negative in same. unfold at_start, at_end in same. rewrite !value_put in same.
      rewrite <- !value_on_period. simpl in same. rewrite Rmult_0_l, Rplus_0_r in same. lra.
Qed.

End Checked.
