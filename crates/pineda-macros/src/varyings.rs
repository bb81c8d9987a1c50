//! `#[derive(Varyings)]`: a struct to a row of numbers and back.

use proc_macro2::{Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Attribute, Data, DeriveInput, Error, GenericParam, Generics, Ident, Member, Meta};

pub(crate) fn expand(item: TokenStream) -> Result<TokenStream, Error> {
    let input: DeriveInput = syn::parse2(item)?;
    let Data::Struct(data) = &input.data else {
        return Err(Error::new_spanned(
            &input.ident,
            "varyings are a struct: an enum or a union cannot be interpolated",
        ));
    };
    if data.fields.is_empty() {
        return Err(Error::new_spanned(&input.ident, "varyings without fields are `()`: no struct is needed"));
    }
    let width = width(&input.ident, &input.generics)?;
    let parameters = quote!(<#width: ::pineda::Lanes>);
    let (name, where_clause) = (&input.ident, &input.generics.where_clause);

    let (mut layout, mut reads, mut writes, mut duals) =
        (quote!(::pineda::__Layout::EMPTY), Vec::new(), Vec::new(), Vec::new());
    let mut offset = quote!(0);
    for (i, field) in data.fields.iter().enumerate() {
        let interpolation = match interpolation(&field.attrs)? {
            Some(variant) => {
                quote!(::core::option::Option::Some(::pineda::Interpolation::#variant))
            }
            None => quote!(::core::option::Option::None),
        };
        let member = field.ident.clone().map_or_else(|| Member::Unnamed(i.into()), Member::Named);
        let ty = &field.ty;
        // Errors about a field that is no varying point at its type.
        let varyings = quote_spanned!(ty.span()=> <#ty as ::pineda::Varyings<#width>>);
        layout = quote!(#layout.with(#varyings::INTERPOLATION, #interpolation));
        reads.push(quote!(#member: #varyings::read(lanes, &rows[(#offset) * <#width as ::pineda::Lanes>::N..])));
        writes.push(quote!(#varyings::write(self.#member, &mut rows[(#offset) * <#width as ::pineda::Lanes>::N..]);));
        duals.push(quote!(#member: #varyings::with_derivatives(self.#member, dx.#member, dy.#member)));
        offset = quote!(#offset + #varyings::LEN);
    }

    Ok(quote! {
        #[automatically_derived]
        impl #parameters ::core::clone::Clone for #name<#width> #where_clause {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
        #[automatically_derived]
        impl #parameters ::core::marker::Copy for #name<#width> #where_clause {}
        #[automatically_derived]
        impl #parameters ::pineda::Varyings<#width> for #name<#width> #where_clause {
            type At<__M: ::pineda::Lanes> = #name<__M>;
            const LEN: usize = #layout.len();
            const INTERPOLATION: &'static [::pineda::Interpolation] = const { &#layout }.interpolation();
            #[inline(always)]
            fn read(lanes: #width, rows: &[f32]) -> Self {
                Self { #(#reads),* }
            }
            #[inline(always)]
            fn write(self, rows: &mut [f32]) {
                #(#writes)*
            }
            #[inline(always)]
            fn with_derivatives(self, dx: Self, dy: Self) -> #name<::pineda::Dual<#width>> {
                #name { #(#duals),* }
            }
        }
    })
}

/// The name of the one type parameter.
fn width<'a>(name: &Ident, generics: &'a Generics) -> Result<&'a Ident, Error> {
    let mut parameters = generics.params.iter();
    match (parameters.next(), parameters.next()) {
        (Some(GenericParam::Type(width)), None) => Ok(&width.ident),
        _ => Err(Error::new(
            Span::call_site(),
            format!(
                "varyings have one type parameter, their width, and no other: `struct {name}<L: Lanes = Scalar>`; \
                 `varyings! {{ struct {name} {{ ... }} }}` writes it for you"
            ),
        )),
    }
}

/// The variant of `Interpolation` that a field's attribute names.
fn interpolation(attributes: &[Attribute]) -> Result<Option<Ident>, Error> {
    let mut found = None;
    for attribute in attributes {
        let variant = if attribute.path().is_ident("flat") {
            "Flat"
        } else if attribute.path().is_ident("noperspective") {
            "NoPerspective"
        } else {
            continue;
        };
        if !matches!(attribute.meta, Meta::Path(_)) {
            return Err(Error::new_spanned(attribute, "this attribute takes no arguments"));
        }
        if found.replace(Ident::new(variant, Span::call_site())).is_some() {
            return Err(Error::new_spanned(
                attribute,
                "a field is interpolated in one way: remove one of the attributes",
            ));
        }
    }
    Ok(found)
}
